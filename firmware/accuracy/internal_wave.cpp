#include <cmath>
#include <numbers>

#include "firmware/accuracy/case.h"

// A8   In a fluid whose density falls linearly with height, N^2 = -(g / rho) d rho/dy, a standing wave of the wave numbers kx
//      and ky swings at omega = N kx / |k| (Boussinesq).

namespace eddy::accuracy {
namespace {

/// omega / N, from the time at which the velocity it started with has gone: a quarter of a period.
std::vector<double> frequency(Laboratory& lab) {
    Run run = lab.start();
    const auto start = [u = lab.scene().initial.velocity_m_s](const glm::dvec3& x_m) {
        return u.evaluate(x_m, 0.0);
    };
    double before = 1.0, now = 1.0;
    for (long n = 0; n < run.steps() && now > 0.0; ++n) {
        run.step();
        before = now;
        now = amplitude(run.velocity(), start);
    }
    const double standstill = run.time_s() - run.dt_s() * now / (now - before);
    const double n_1_s = std::sqrt(lab.scene().smoke->weight * glm::length(lab.scene().fluid.gravity_m_s2) /
                                   lab.scene().tank.size_m.y);
    return {0.5 * std::numbers::pi / (standstill * n_1_s)};
}

Case wave(const std::string& name, const std::string& title, double exact, std::vector<int> quick,
          std::vector<int> full) {
    const Limit limit{quick.back(), 0.02};
    return {.name = name,
            .title = title,
            .scene = "validation/" + name,
            .time_step = TimeStep::Courant,
            .quick = std::move(quick),
            .full = std::move(full),
            .quantities = {{.name = "omega / N",
                            .exact = exact,
                            .source = "dispersion of internal waves, kx / |k|",
                            .error = Quantity::Error::Relative,
                            .limits = {limit}}},
            .measure = frequency};
}

}  // namespace

std::vector<Case> internal_wave_cases() {
    return {wave("A8-square", "internal wave as wide as high", std::sqrt(0.5), {16, 32}, {16, 32, 64}),
            wave("A8-wide", "internal wave twice as wide as high", std::sqrt(0.2), {32, 48}, {32, 48, 96})};
}

}  // namespace eddy::accuracy
