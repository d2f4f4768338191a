#include "firmware/stability/criteria.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace eddy::stability {
namespace {

using Complaint = std::optional<std::string>;

/// After these an impulsive start is over.
constexpr long kSettlingSteps = 10;
/// Of shorter runs nobody can say whether something levels off.
constexpr long kLongEnough = 400;

double pressure_of(const History::Look& look) {
    return std::max(std::abs(look.pressure_pa.low), std::abs(look.pressure_pa.high));
}

/// The most of a figure over looks from one share of the run to another.
template <class Figure>
double most(const History& history, double from, double to, Figure figure) {
    const auto steps = static_cast<double>(history.planned_steps);
    double found = 0.0;
    for (const History::Look& look : history.looks)
        if (const auto step = static_cast<double>(look.step); step >= from * steps && step < to * steps)
            found = std::max(found, figure(look));
    return found;
}

double force_n(const History::Step& step, std::size_t body = 0) {
    return body < step.loads.size() ? glm::length(step.loads[body].force_n) : 0.0;
}

double peak_force_n(const History& history, std::size_t body = 0) {
    double peak = 0.0;
    for (const History::Step& step : history.steps) peak = std::max(peak, force_n(step, body));
    return peak;
}

Criterion levels_off(double (*figure)(const History::Look&), double factor, const char* what) {
    return [=](const History& history) -> Complaint {
        if (history.planned_steps < kLongEnough) return {};
        const double before = most(history, 0.5, 0.75, figure), last = most(history, 0.75, 1.0, figure);
        if (last <= factor * before) return {};
        return fmt::format("{} still grows: {:.3g} in the third quarter, {:.3g} in the last", what, before,
                           last);
    };
}

}  // namespace

Criterion pressure_bounded(double speed_m_s) {
    return [=](const History& history) -> Complaint {
        const Tank& tank = history.tank;
        double longest_dt_s = 0.0;
        for (const History::Step& step : history.steps) longest_dt_s = std::max(longest_dt_s, step.dt_s);
        const double scale =
            tank.density_kg_m3 * (speed_m_s * speed_m_s + speed_m_s * tank.longest_m() / longest_dt_s);
        const double found = most(history, 0.0, 1.0, pressure_of);
        if (found <= 100.0 * scale) return {};
        return fmt::format(
            "pressure of {:.3g} Pa, {:.0f} times what it takes to set the tank going in a step", found,
            found / scale);
    };
}

Criterion pressure_levels_off() {
    return levels_off(pressure_of, 1.5, "pressure");
}

Criterion energy_levels_off() {
    return levels_off([](const History::Look& look) { return look.energy_j; }, 1.1, "kinetic energy");
}

Criterion energy_never_rises() {
    return [](const History& history) -> Complaint {
        double least = std::numeric_limits<double>::infinity();
        for (const History::Look& look : history.looks) {
            if (look.energy_j > 1.001 * least)
                return fmt::format("kinetic energy rose by {:.2g} % by step {}",
                                   100.0 * (look.energy_j / least - 1.0), look.step + 1);
            least = std::min(least, look.energy_j);
        }
        return {};
    };
}

Criterion speed_never_rises() {
    return [](const History& history) -> Complaint {
        for (const History::Look& look : history.looks)
            if (look.speed_m_s > 1.001 * history.looks.front().speed_m_s)
                return fmt::format(
                    "by step {} the largest speed is {:.4g} m/s, after the first it was {:.4g} m/s",
                    look.step + 1, look.speed_m_s, history.looks.front().speed_m_s);
        return {};
    };
}

Criterion no_faster_than_a_fall(double expansion_1_k) {
    return [=](const History& history) -> Complaint {
        double warmest = 0.0;
        for (const History::Look& look : history.looks) {
            warmest = std::max({warmest, look.temperature_k.high, -look.temperature_k.low});
            const double limit = 1.5 * std::sqrt(2.0 * history.gravity_m_s2 * expansion_1_k * warmest *
                                                 history.tank.longest_m());
            if (look.speed_m_s > limit + 1e-3)
                return fmt::format("{:.3g} m/s at step {}; falling through the tank makes {:.3g} m/s",
                                   look.speed_m_s, look.step + 1, limit / 1.5);
        }
        return {};
    };
}

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

Criterion volume_balances(double share) {
    return [=](const History& history) -> Complaint {
        double most_m3_s = 0.0, worst = 0.0;
        long worst_step = 0;
        for (const History::Look& look : history.looks) {
            most_m3_s = std::max(most_m3_s, look.in_m3_s);
            if (look.step < kSettlingSteps || !(std::abs(look.net_m3_s) > worst * most_m3_s)) continue;
            worst = std::abs(look.net_m3_s) / most_m3_s;
            worst_step = look.step;
        }
        if (worst <= share) return {};
        return fmt::format("{:.2g} of what flows in does not flow out (step {})", worst, worst_step + 1);
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
        double answered_s = 0.0;
        for (const History::Tick& tick : history.ticks) {
            if (tick.answered) answered_s = tick.time_s;
            if (tick.time_s - answered_s > within_s + 1e-6 && tick.force_n > 0.0)
                return fmt::format("{:.0f} ms after the last answer the hand still gets {:.2g} N",
                                   1e3 * (tick.time_s - answered_s), tick.force_n);
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
        for (std::size_t n = 0; n < history.steps.size(); ++n) {
            const History::Step& step = history.steps[n];
            if (step.bodies.empty() || step.loads.empty()) return {};
            // The ball's radius is a fifth of the shortest side.
            const double radius = 0.2 * std::min({size.x, size.y, size.z}) + 2.0 * history.tank.cell_m;
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

Criterion energy_decays(long by_step) {
    return [=](const History& history) -> Complaint {
        for (const History::Look& look : history.looks)
            if (look.step >= by_step && look.energy_j > 0.1 * history.start_energy_j)
                return fmt::format("step {} has {:.0f} % of the kinetic energy of the start", look.step + 1,
                                   100.0 * look.energy_j / history.start_energy_j);
        return {};
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
        const double nominal_s = history.steps.front().dt_s, peak = peak_force_n(history);
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

Criterion all_of(std::vector<Criterion> criteria) {
    return [criteria = std::move(criteria)](const History& history) -> Complaint {
        for (const Criterion& criterion : criteria)
            if (Complaint complaint = criterion(history)) return complaint;
        return {};
    };
}

}  // namespace eddy::stability
