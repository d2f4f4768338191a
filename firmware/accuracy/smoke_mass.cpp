#include <cmath>
#include <numbers>

#include "firmware/accuracy/case.h"

// A16  Smoke in a closed tank is neither made nor lost by stirring. Neither semi-Lagrangian nor MacCormack transport
//      conserves it exactly; how much they lose or make is what is measured.

namespace eddy::accuracy {
namespace {

/// Smoke at the end over that after the first step, minus 1.
std::vector<double> drift(Laboratory& lab) {
    Run run = lab.start();
    run.diagnose();
    const double start = run.step().diagnostics->smoke_total;
    return {run.step_to_end().diagnostics->smoke_total / start - 1.0};
}

/// Smoke gained per second over what the source gives.
std::vector<double> gain(Laboratory& lab) {
    Run run = lab.start();
    run.diagnose();
    const double total = run.step_to_end().diagnostics->smoke_total;
    const Scene::Source& source = lab.scene().sources[0];
    const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(source.radius_m, 3);
    return {total / (run.time_s() * *source.smoke_per_s * volume)};
}

Case stirred(const std::string& name, const std::string& title, std::vector<std::string> set) {
    return {
        .name = name,
        .title = title,
        .scene = "validation/A16",
        .set = std::move(set),
        .time_step = TimeStep::Courant,
        .quick = {32},
        .full = {24, 32, 48, 64},
        .quantities = {{.name = "M / M_0 - 1", .source = "conservation of smoke", .limits = {{32, 0.02}}}},
        .measure = drift};
}

}  // namespace

std::vector<Case> smoke_mass_cases() {
    return {stirred("A16-precise", "smoke after 10 s of stirring, MacCormack", {}),
            stirred("A16-fast", "the same, semi-Lagrangian", {"solver.preset=\"fast\""}),
            {.name = "A16-source",
             .title = "smoke from a source over what it gives",
             .scene = "validation/A16-source",
             .quick = {16, 32},
             .full = {16, 32, 64},
             .quantities = {{.name = "gain / source",
                             .exact = 1.0,
                             .source = "volume of the source's ball",
                             .error = Quantity::Error::Relative,
                             .limits = {{32, 0.01}}}},
             .measure = gain}};
}

}  // namespace eddy::accuracy
