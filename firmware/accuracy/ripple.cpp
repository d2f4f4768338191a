#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/accuracy/case.h"

// B8.7 A ball that glides evenly should feel an even force; what trembles as it crosses the cells is the solver's, and a
//      hand feels it as ticking. d'Alembert: without friction the even part is 0 too.

namespace eddy::accuracy {
namespace {

struct Trace {
    double mean;    // drag coefficient
    double ripple;  // rms of what is left of it when a moving mean over two cells to either side is taken out
};

Trace glide(Laboratory& lab) {
    const Scene& scene = lab.scene();
    const Scene::Body& ball = scene.bodies[0];
    const double speed = ball.velocity_m_s.x;
    const double push =
        0.5 * scene.fluid.density_kg_m3 * speed * speed * std::numbers::pi * ball.radius_m * ball.radius_m;
    std::vector<double> drag;
    lab.start().step_to_end(
        [&](const gles::StepResult& result) { drag.push_back(-result.loads[0].force_n.x / push); });

    const auto half =
        static_cast<std::size_t>(std::lround(2.0 * scene.tank.cell_m() / (speed * scene.solver.dt_s)));
    const std::size_t settled = 2 * drag.size() / 5;
    double sum = 0.0, squares = 0.0;
    std::size_t count = 0;
    for (std::size_t n = std::max(settled, half); n + half < drag.size(); ++n, ++count) {
        double mean = 0.0;
        for (std::size_t m = n - half; m <= n + half; ++m)
            mean += drag[m] / static_cast<double>(2 * half + 1);
        sum += drag[n];
        squares += (drag[n] - mean) * (drag[n] - mean);
    }
    return {sum / static_cast<double>(count), std::sqrt(squares / static_cast<double>(count))};
}

std::vector<double> ripple_and_drag(Laboratory& lab) {
    const Trace trace = glide(lab);
    return {trace.ripple, trace.mean};
}

std::vector<double> share_of_drag(Laboratory& lab) {
    const Trace trace = glide(lab);
    return {trace.ripple / trace.mean, trace.mean};
}

Case inviscid(const std::string& name, const std::string& title, std::vector<std::string> set,
              std::vector<Limit> limits) {
    return {.name = name,
            .title = title,
            .scene = "validation/B8.7",
            .set = std::move(set),
            .time_step = TimeStep::Courant,
            .quick = {48},
            .full = {48, 72, 96},
            .quantities = {{.name = "ripple of C_D",
                            .source = "an even motion has an even force",
                            .limits = std::move(limits)},
                           {.name = "mean C_D", .source = "d'Alembert"}},
            .measure = ripple_and_drag};
}

}  // namespace

std::vector<Case> ripple_cases() {
    const std::vector<Limit> limit{{48, 0.005}};
    std::vector<Case> cases{inviscid("B8.7-fast", "ripple of a ball of 4 cells that glides without friction",
                                     {"solver.preset=\"fast\""}, limit),
                            inviscid("B8.7-precise", "the same", {}, limit),
                            inviscid("B8.7-yang2009", "the same with the method of 2009, for comparison",
                                     {"solver.preset=\"yang2009\""}, {})};
    cases.back().quick.clear();  // Jacobi sweeps are slow: several times the time of all the others
    cases.push_back(
        {.name = "B8.7-viscous",
         .title = "ripple of the ball in a viscous fluid, Re 20, as a share of its drag",
         .scene = "validation/B8.7",
         .set = {"fluid.viscosity_pa_s=0.4"},
         .time_step = TimeStep::Courant,
         .quick = {48},
         .full = {48, 72, 96},
         .quantities = {{.name = "ripple / mean drag",
                         .source = "an even motion has an even force",
                         .limits = {{48, 0.01}}},
                        {.name = "mean C_D",
                         .exact = 2.728,
                         .source =
                             "steady axisymmetric spectral solution, unbounded; the tank's walls are near",
                         .error = Quantity::Error::Relative}},
         .measure = share_of_drag});
    return cases;
}

}  // namespace eddy::accuracy
