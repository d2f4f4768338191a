#include "firmware/stability/criteria.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eddy::stability {
namespace {

using Complaint = std::optional<std::string>;

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

/// What it takes to set the tank going at a speed in one step, and the pressure of a stream of that speed.
double setting_off_pa(const History& history, double speed_m_s) {
    const Tank& tank = history.tank;
    double longest_dt_s = 0.0;
    for (const History::Step& step : history.steps) longest_dt_s = std::max(longest_dt_s, step.dt_s);
    return tank.density_kg_m3 * (speed_m_s * speed_m_s + speed_m_s * tank.longest_m() / longest_dt_s);
}

Criterion levels_off(double (*figure)(const History::Look&), double factor, const char* what) {
    return [=](const History& history) -> Complaint {
        if (history.planned_steps < kLevelSteps) return {};
        const double before = most(history, 0.5, 0.75, figure), last = most(history, 0.75, 1.0, figure);
        if (last <= factor * before) return {};
        return fmt::format("{} still grows: {:.3g} in the third quarter, {:.3g} in the last", what, before,
                           last);
    };
}

}  // namespace

Criterion pressure_bounded(double speed_m_s) {
    return [=](const History& history) -> Complaint {
        const double scale = setting_off_pa(history, speed_m_s);
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

Criterion pressure_levels_off_or_is_small(double speed_m_s) {
    return [=](const History& history) -> Complaint {
        const double last = most(history, 0.75, 1.0, pressure_of);
        return last < 10.0 * setting_off_pa(history, speed_m_s) ? std::nullopt
                                                                : pressure_levels_off()(history);
    };
}

Criterion energy_levels_off() {
    return levels_off([](const History::Look& look) { return look.energy_j; }, 1.1, "kinetic energy");
}

Criterion energy_levels_off_or_is_small() {
    return [](const History& history) -> Complaint {
        double fastest = 0.0;
        for (const History::Step& step : history.steps)
            for (const gles::BodyState& body : step.bodies)
                fastest = std::max(fastest, glm::length(body.velocity_m_s));
        const double all_j = 0.5 * history.tank.mass_kg() * fastest * fastest;
        const double last = most(history, 0.75, 1.0, [](const History::Look& look) { return look.energy_j; });
        return last < 0.1 * all_j ? std::nullopt : energy_levels_off()(history);
    };
}

Criterion energy_never_rises() {
    return [](const History& history) -> Complaint {
        double least = history.start_energy_j;
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
            if (look.speed_m_s > 1.001 * history.start_speed_m_s)
                return fmt::format(
                    "by step {} the largest speed is {:.4g} m/s, at the start it was {:.4g} m/s",
                    look.step + 1, look.speed_m_s, history.start_speed_m_s);
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

Remark remark_on_time() {
    return [](const History& history) {
        const auto median_s = [&](std::size_t from, std::size_t to) {
            std::vector<double> took;
            for (std::size_t n = from; n < to; ++n) took.push_back(history.steps[n].wall_s);
            if (took.empty()) return 0.0;
            const auto middle = took.begin() + static_cast<std::ptrdiff_t>(took.size() / 2);
            std::nth_element(took.begin(), middle, took.end());
            return *middle;
        };
        const std::size_t all = history.steps.size(), fifth = all / 5;
        const double first_s = median_s(0, fifth), last_s = median_s(all - fifth, all);
        return fmt::format("a step of the last fifth takes {:.2f} times as long as one of the first",
                           first_s > 0.0 ? last_s / first_s : 0.0);
    };
}

Remark remark_on_energy() {
    return [](const History& history) {
        const double end_j = history.looks.empty() ? 0.0 : history.looks.back().energy_j;
        return fmt::format("{:.2g} of the kinetic energy of the start are left at the end",
                           history.start_energy_j > 0.0 ? end_j / history.start_energy_j : 0.0);
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

Criterion all_of(std::vector<Criterion> criteria) {
    return [criteria = std::move(criteria)](const History& history) -> Complaint {
        for (const Criterion& criterion : criteria)
            if (Complaint complaint = criterion(history)) return complaint;
        return {};
    };
}

}  // namespace eddy::stability
