#include "firmware/accuracy/case.h"

// A17  As much flows out of a tank as flows in: div u = 0, summed over all of it.

namespace eddy::accuracy {
namespace {

std::vector<double> balance(Laboratory& lab) {
    Run run = lab.start();
    run.step_to_end();
    const FaceVelocity u = run.velocity();
    double in = 0.0, net = 0.0;  // through the six walls, in units of a face
    u.for_each_face([&](const glm::ivec3& c, int k, double) {
        const double inwards = c[k] == 0 ? u.at(c, k) : c[k] == u.cells()[k] ? -u.at(c, k) : 0.0;
        net += inwards;
        if (k == 0 && c.x == 0) in += inwards;
    });
    return {net / in};
}

}  // namespace

std::vector<Case> inflow_cases() {
    const auto inflow = [](const std::string& name, const std::string& title, std::vector<std::string> set,
                           double limit) {
        return Case{.name = name,
                    .title = title,
                    .scene = "validation/A17",
                    .set = std::move(set),
                    .time_step = TimeStep::Courant,
                    .quick = {25},
                    .full = {25, 50},
                    .quantities = {{.name = "net flow / inflow",
                                    .source = "conservation of volume",
                                    .limits = {{25, limit}}}},
                    .measure = balance};
    };
    return {
        inflow("A17-solved", "what flows in at one side and not out at the other, around a ball", {}, 1e-5),
        inflow("A17-precise", "the same with the three cycles of the precise preset", {"solver.cycles=3"},
               1e-2)};
}

}  // namespace eddy::accuracy
