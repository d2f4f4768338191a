#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "firmware/stability/criteria.h"

namespace eddy::stability {
namespace {

using Complaint = std::optional<std::string>;

/// Of the ball in the common scene.
double ball_radius_m(const Tank& tank) {
    return 0.2 * tank.cell_m * std::min({tank.cells.x, tank.cells.y, tank.cells.z});
}

double force_n(const History::Step& step, std::size_t body = 0) {
    return body < step.loads.size() ? glm::length(step.loads[body].force_n) : 0.0;
}

/// Of the peak of a force: what two runs of the same steps differ by in single precision, and no more.
constexpr double kRounding = 1e-4;

double peak_force_n(const History& history, std::size_t body = 0) {
    double peak = 0.0;
    for (const History::Step& step : history.steps) peak = std::max(peak, force_n(step, body));
    return peak;
}

struct Difference {
    double share = 0.0;  ///< of the peak
    std::size_t step = 0;
};

/// The worst of a difference over the steps, to the peak of a size.
template <class Apart, class Size>
Difference worst_difference(std::size_t steps, Apart apart, Size size) {
    double peak = 0.0, most = 0.0;
    Difference worst;
    for (std::size_t n = 0; n < steps; ++n) {
        peak = std::max(peak, size(n));
        if (const double found = apart(n); found > most) {
            most = found;
            worst.step = n;
        }
    }
    worst.share = peak > 0.0 ? most / peak : 0.0;
    return worst;
}

Difference imbalance(const History& history) {
    const auto sum = [&](std::size_t n, bool of_fluid) {
        const History::Step& step = history.steps[n];
        glm::dvec3 force(0.0);
        for (std::size_t i = 0; i < step.methods.size() && i < step.loads.size(); ++i)
            force += of_fluid ? step.methods[i].box_n : step.loads[i].force_n;
        return force;
    };
    return worst_difference(
        history.steps.size(), [&](std::size_t n) { return glm::length(sum(n, true) - sum(n, false)); },
        [&](std::size_t n) {
            double size = 0.0;
            for (const gles::Load& load : history.steps[n].loads) size += glm::length(load.force_n);
            return size;
        });
}

Difference from_common(const History& history, double factor) {
    const auto here = [&](std::size_t n) {
        return history.steps[n].loads.empty() ? glm::dvec3(0.0) : history.steps[n].loads[0].force_n;
    };
    return worst_difference(
        std::min(history.common_n.size(), history.steps.size()),
        [&](std::size_t n) { return glm::length(here(n) / factor - history.common_n[n]); },
        [&](std::size_t n) { return glm::length(history.common_n[n]); });
}

}  // namespace

Criterion gives_back_no_more() {
    return [](const History& history) -> Complaint {
        double work_j = 0.0, given_j = 0.0;
        for (const History::Step& step : history.steps)
            for (std::size_t i = 0; i < std::min(step.loads.size(), step.bodies.size()); ++i) {
                const double work =
                    -step.dt_s * (glm::dot(step.loads[i].force_n, step.bodies[i].velocity_m_s) +
                                  glm::dot(step.loads[i].torque_nm, step.bodies[i].spin_rad_s));
                work_j += work;
                given_j += std::max(0.0, work);
            }
        if (work_j >= -1e-6 * given_j) return {};
        return fmt::format("the fluid gave back {:.3g} J more than the {:.3g} J it was given", -work_j,
                           given_j);
    };
}

Criterion force_is_continuous(std::size_t i, double share, long settling) {
    return [=](const History& history) -> Complaint {
        const double peak = peak_force_n(history, i);
        for (std::size_t n = static_cast<std::size_t>(settling) + 1; n < history.steps.size(); ++n) {
            const History::Step &last = history.steps[n - 1], &now = history.steps[n];
            if (i >= now.loads.size()) return {};
            const double jump = glm::length(now.loads[i].force_n - last.loads[i].force_n);
            if (jump > share * peak)
                return fmt::format("the force jumps by {:.0f} % of its peak at step {}", 100.0 * jump / peak,
                                   n + 1);
        }
        return {};
    };
}

Criterion hand_let_go(double within_s) {
    return [=](const History& history) -> Complaint {
        const double period_s = history.steps.empty() ? 0.0 : history.steps.front().dt_s;
        double due_s = 0.0;
        for (const History::Tick& tick : history.ticks) {
            if (tick.answered) due_s = tick.time_s + period_s;
            if (tick.time_s - due_s > within_s + 1e-6 && tick.force_n > 0.0)
                return fmt::format(
                    "{:.0f} ms after an answer was due that did not come the hand still gets {:.2g} N",
                    1e3 * (tick.time_s - due_s), tick.force_n);
        }
        return {};
    };
}

Criterion force_recovers(double within_s) {
    return [=](const History& history) -> Complaint {
        const double peak = peak_force_n(history);
        double disturbed_s = 0.0;
        for (const History::Step& step : history.steps) {
            if (step.disturbed) disturbed_s = step.time_s;
            if (step.time_s - disturbed_s > within_s + 1e-6 && force_n(step) > 0.02 * peak)
                return fmt::format("{:.2f} s after the last disturbance the force is {:.2g} % of its peak",
                                   step.time_s - disturbed_s, 100.0 * force_n(step) / peak);
        }
        return {};
    };
}

Criterion same_after_each_reset() {
    return [](const History& history) -> Complaint {
        // Steps since the reset before them, in the first stretch and in every other.
        std::vector<glm::dvec3> first;
        std::size_t since = 0;
        for (std::size_t n = 0; n < history.steps.size(); ++n) {
            const History::Step& step = history.steps[n];
            since = n > 0 && step.resets == history.steps[n - 1].resets ? since + 1 : 0;
            if (step.loads.empty()) return {};
            if (step.resets == 0)
                first.push_back(step.loads[0].force_n);
            else if (since < first.size() && step.loads[0].force_n != first[since])
                return fmt::format("after reset {} step {} has another force than after the start",
                                   step.resets, since + 1);
        }
        return {};
    };
}

Criterion no_force_outside() {
    return [](const History& history) -> Complaint {
        const glm::dvec3 size = history.tank.cell_m * glm::dvec3(history.tank.cells);
        const double radius = ball_radius_m(history.tank) + 2.0 * history.tank.cell_m;
        for (std::size_t n = 0; n < history.steps.size(); ++n) {
            const History::Step& step = history.steps[n];
            if (step.bodies.empty() || step.loads.empty()) return {};
            const glm::dvec3& at = step.bodies[0].centre_m;
            const bool outside = glm::any(glm::lessThan(at, glm::dvec3(-radius))) ||
                                 glm::any(glm::greaterThan(at, size + radius));
            if (outside && force_n(step) > 0.0)
                return fmt::format("the force is {:.3g} N at step {}, with the body outside", force_n(step),
                                   n + 1);
        }
        return {};
    };
}

Criterion returns_smoothly() {
    return [](const History& history) -> Complaint {
        constexpr double kSlew = 2.0;
        const glm::dvec3 size = history.tank.cell_m * glm::dvec3(history.tank.cells);
        const double radius = ball_radius_m(history.tank);
        double peak = 0.0;
        for (std::size_t n = kSettlingSteps; n < history.steps.size(); ++n)
            peak = std::max(peak, force_n(history.steps[n]));
        // How far the ball reaches out of the tank, the farthest way; negative: it is inside.
        const auto out_m = [&](const History::Step& step) {
            const glm::dvec3 out = glm::abs(step.bodies[0].centre_m - 0.5 * size) - 0.5 * size + radius;
            return std::max({out.x, out.y, out.z});
        };
        for (std::size_t n = kSettlingSteps + 1; n < history.steps.size(); ++n) {
            const History::Step &last = history.steps[n - 1], &now = history.steps[n];
            if (now.bodies.empty() || now.loads.empty()) return {};
            const double way = out_m(last) - out_m(now);
            if (!now.disturbed) return {};  // it has stopped at once
            if (way <= 0.0 || out_m(now) < -2.0 * radius) continue;
            const double jump = glm::length(now.loads[0].force_n - last.loads[0].force_n);
            const double most = kSlew * way / radius * peak;
            if (jump > most)
                return fmt::format(
                    "coming back through the wall the force jumps by {:.0f} % of its peak at step {}; "
                    "{:.0f} % would do for a ball that comes so far in",
                    100.0 * jump / peak, n + 1, 100.0 * most / peak);
        }
        return {};
    };
}

Criterion forces_balance(double share) {
    return [=](const History& history) -> Complaint {
        const Difference worst = imbalance(history);
        if (worst.share <= share) return {};
        return fmt::format(
            "the bodies feel {:.2g} of the peak more or less than the fluid's momentum loses at step {}",
            worst.share, worst.step + 1);
    };
}

Remark remark_on_balance() {
    return [](const History& history) {
        return fmt::format("forces and the fluid's momentum agree within {:.1g} of the peak",
                           imbalance(history).share);
    };
}

Criterion is_forgotten(std::size_t at, std::size_t within) {
    return [=](const History& history) -> Complaint {
        const auto largest_n = [&](std::size_t from, std::size_t to) {
            double most = 0.0;
            for (std::size_t n = from; n < std::min({to, history.common_n.size(), history.steps.size()}); ++n)
                if (!history.steps[n].loads.empty())
                    most =
                        std::max(most, glm::length(history.steps[n].loads[0].force_n - history.common_n[n]));
            return most;
        };
        const double first = largest_n(at, at + within), later = largest_n(at + within, history.steps.size());
        if (later <= std::max(0.1 * first, kRounding * peak_force_n(history))) return {};
        return fmt::format("the fault changes the force by {:.2g} N, and {} steps later still by {:.2g} N",
                           first, within, later);
    };
}

Criterion same_as_common(double factor, double share) {
    return [=](const History& history) -> Complaint {
        const Difference worst = from_common(history, factor);
        if (worst.share <= share) return {};
        return fmt::format(
            "in its own units the force is off that of the common scene by {:.2g} of the peak "
            "at step {}",
            worst.share, worst.step + 1);
    };
}

Remark remark_on_common(double factor) {
    return [=](const History& history) {
        return fmt::format("forces are those of the common scene within {:.1g} of the peak",
                           from_common(history, factor).share);
    };
}

Criterion loads_stay_finite() {
    return [](const History& history) -> Complaint {
        for (std::size_t n = 0; n < history.steps.size(); ++n)
            for (const gles::Load& load : history.steps[n].loads)
                if (!std::isfinite(glm::length(load.force_n) + glm::length(load.torque_nm)))
                    return fmt::format("step {} hands out a load that is not finite", n + 1);
        return {};
    };
}

Criterion no_time_no_news() {
    return [](const History& history) -> Complaint {
        const double nominal_s = history.steps.empty() ? 0.0 : history.steps.front().dt_s;
        const double peak = peak_force_n(history);
        for (std::size_t n = 1; n < history.steps.size(); ++n) {
            const History::Step &last = history.steps[n - 1], &now = history.steps[n];
            if (now.dt_s > 1e-3 * nominal_s || now.loads.empty()) continue;
            const double jump = glm::length(now.loads[0].force_n - last.loads[0].force_n);
            if (!(jump <= 1e-3 * peak))
                return fmt::format("a step of {:.2g} s changes the force by {:.2g} of its peak (step {})",
                                   now.dt_s, jump / peak, n + 1);
        }
        return {};
    };
}

Criterion no_other_lines(double frequency_hz) {
    return [=](const History& history) -> Complaint {
        // The second half of what is disturbed, of whole periods.
        std::vector<double> force;
        double dt_s = 0.0;
        for (const History::Step& step : history.steps)
            if (step.disturbed && !step.loads.empty()) {
                force.push_back(step.loads[0].force_n.x);
                dt_s = step.dt_s;
            }
        if (force.empty() || !(dt_s > 0.0)) return {};
        force.erase(force.begin(), force.begin() + static_cast<std::ptrdiff_t>(force.size() / 2));
        const auto period = static_cast<std::size_t>(std::lround(1.0 / (frequency_hz * dt_s)));
        const std::size_t periods = force.size() / period, n = periods * period;
        if (periods < 4) return {};
        double main = 0.0, other = 0.0, worst_hz = 0.0;
        for (std::size_t line = 1; line <= n / 2; ++line) {
            std::complex<double> sum;
            for (std::size_t i = 0; i < n; ++i)
                sum += force[i] * std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(line * i) /
                                                      static_cast<double>(n));
            const double height = std::abs(sum);
            if (line % periods == 0) {
                main = std::max(main, height);
            } else if (height > other) {
                other = height;
                worst_hz = static_cast<double>(line) / (static_cast<double>(n) * dt_s);
            }
        }
        if (other <= 0.05 * main) return {};
        return fmt::format("a line of the force at {:.1f} Hz is {:.0f} % of that of the motion", worst_hz,
                           100.0 * other / main);
    };
}

}  // namespace eddy::stability
