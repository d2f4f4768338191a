#include "firmware/stability/case.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/diagnostic.h"
#include "config/nearest.h"
#include "firmware/input_error.h"

namespace eddy::stability {

std::string_view to_word(Effort effort) {
    return effort == Effort::Default ? "default" : "least";
}

std::string grid_name(const glm::ivec3& cells) {
    if (cells.x == cells.y && cells.y == cells.z) return fmt::format("{}^3", cells.x);
    return fmt::format("{}x{}x{}", cells.x, cells.y, cells.z);
}

glm::ivec3 grid_named(const std::string& name) {
    int x = 0, y = 0, z = 0, end = 0;
    const auto whole = [&] { return end == static_cast<int>(name.size()); };
    const bool good =
        (std::sscanf(name.c_str(), "%dx%dx%d%n", &x, &y, &z, &end) == 3 && whole()) ||
        ((end = 0, std::sscanf(name.c_str(), "%d^3%n", &x, &end) == 1) && whole() && (y = z = x)) ||
        ((end = 0, std::sscanf(name.c_str(), "%d%n", &x, &end) == 1) && whole() && (y = z = x));
    if (!good || std::min({x, y, z}) < 4 || std::max({x, y, z}) > 512)
        throw InputError(fmt::format("--grid {}: write a grid as 25, 25^3 or 33x47x29, of 4 to 512 cells",
                                     in_quotes(name)));
    return {x, y, z};
}

const std::vector<Case>& all_cases() {
    static const std::vector<Case> cases = [] {
        std::vector<Case> all;
        for (auto* const page : {jet_cases, time_cases, hand_cases, wall_cases, body_cases, distance_cases,
                                 friction_cases, effect_cases, number_cases, fault_cases})
            for (Case& one : page()) all.push_back(std::move(one));
        std::stable_sort(all.begin(), all.end(),
                         [](const Case& a, const Case& b) { return a.number < b.number; });
        return all;
    }();
    return cases;
}

const std::vector<NotTried>& not_offered() {
    static const std::vector<NotTried> list{
        {22, "half-float textures",
         "this version computes in 32 bits only; the values that would leave 16 bits are "
         "driven through it all the same (past-65504, below-6e-8)"},
        {24, "a context that is lost and restored",
         "no driver of the reference machines reports one; what comes after, "
         "textures with garbage, is tried (garbage-reset)"},
        {31, "splashes, drops, an empty and a full tank", "there is no free surface in this version"},
        {32, "shear-thinning fluids and yield stress", "viscosity is constant in this version"},
    };
    return list;
}

const std::vector<NotTried>& tried_elsewhere() {
    static const std::vector<NotTried> list{
        {21, "a hundred thousand steps, with nobody there and with somebody who stirs",
         "the exhibit itself takes them, judged by what drifts: eddy stability --endless 100000"},
    };
    return list;
}

std::vector<const Case*> cases_named(const std::string& name) {
    std::vector<const Case*> found;
    for (const Case& one : all_cases())
        if (one.name == name || std::to_string(one.number) == name) found.push_back(&one);
    if (!found.empty()) return found;
    for (const auto* const list : {&not_offered(), &tried_elsewhere()})
        for (const NotTried& one : *list)
            if (std::to_string(one.number) == name)
                throw InputError(fmt::format("--case {}: {}: {}", name, one.what, one.why));
    std::vector<std::string_view> names;
    for (const Case& one : all_cases()) names.push_back(one.name);
    throw InputError(fmt::format("--case {}: there is no such case; nearest first: {}", in_quotes(name),
                                 listed(nearest_first(name, names))));
}

}  // namespace eddy::stability
