#include "firmware/accuracy/case.h"

#include <fmt/format.h>

#include "config/diagnostic.h"
#include "config/nearest.h"
#include "firmware/input_error.h"

namespace eddy::accuracy {

const std::vector<Case>& all_cases() {
    static const std::vector<Case> cases = [] {
        std::vector<Case> all;
        for (auto* const page :
             {taylor_green_cases,  exact_flow_cases,    rest_cases,        internal_wave_cases,
              cavity_cases,        viscous_flow_cases,  deformation_cases, smoke_mass_cases,
              inflow_cases,        confinement_cases,   archimedes_cases,  added_mass_cases,
              creeping_flow_cases, swinging_ball_cases, sphere_drag_cases, disk_and_cube_cases,
              balance_cases,       invariance_cases,    reciprocity_cases, ripple_cases,
              free_ball_cases,     three_ways_cases})
            for (Case& one : page()) all.push_back(std::move(one));
        return all;
    }();
    return cases;
}

std::vector<const Case*> cases_named(const std::string& name) {
    std::vector<const Case*> found;
    for (const Case& one : all_cases()) {
        if (one.name == name || one.name.starts_with(name + "-") || one.name.starts_with(name + "."))
            found.push_back(&one);
    }
    if (!found.empty()) return found;
    std::vector<std::string_view> names;
    for (const Case& one : all_cases()) names.push_back(one.name);
    throw InputError(fmt::format("--case {}: there is no such case; nearest first: {}", in_quotes(name),
                                 listed(nearest_first(name, names))));
}

}  // namespace eddy::accuracy
