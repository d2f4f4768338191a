#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "firmware/haptic_study/report.h"

namespace eddy::haptic_study {
namespace {

// What is felt: vibration of half a percent of the force is not; a tremor of 0.05 N or 0.1 mm is no tremor.
constexpr double kRoughness = 0.005, kPull = 0.02, kRateHz = 50.0;

const CircleRow* other(const Study& study, const CircleRow& model) {
    for (const CircleRow& row : study.circles)
        if (row.law == ForceLaw::Filter && row.fluid == model.fluid && row.rate_hz == model.rate_hz)
            return &row;
    return nullptr;
}

Goal roughness(const Study& study, bool known) {
    double worst = 0.0, of_reference = 0.0;
    for (const CircleRow& row : study.circles) {
        if (row.law != ForceLaw::Model || row.rate_hz != kRateHz || (row.fluid == kKnown) != known) continue;
        if (row.figures.roughness < worst) continue;
        worst = row.figures.roughness;
        of_reference = row.figures.reference_trembling;
    }
    return {fmt::format("roughness at 50 answers a second at most 0.5 %, {}",
                        known ? "in the known fluid" : "in every scene"),
            known ? fmt::format("{:.2f} %", 100.0 * worst)
                  : fmt::format("{:.2f} % at the worst; there the fluid at 1 kHz itself trembles by {:.2f} %",
                                100.0 * worst, 100.0 * of_reference),
            worst <= kRoughness};
}

/// Of what is felt alone: what no reference has a part in.
Goal trembling(const Study& study) {
    double worst = 0.0;
    for (const CircleRow& row : study.circles)
        if (row.law == ForceLaw::Model && row.rate_hz == kRateHz)
            worst = std::max(worst, row.figures.trembling);
    return {"what is felt by itself trembles by at most 0.5 % at 50 answers a second",
            fmt::format("{:.2f} % at the worst", 100.0 * worst), worst <= kRoughness};
}

Goal latency(const Study& study) {
    std::string found;
    bool good = true;
    for (const CircleRow& row : study.circles) {
        const CircleRow* filter = other(study, row);
        if (row.law != ForceLaw::Model || row.fluid != kKnown || row.rate_hz > 100.0 || !filter) continue;
        const auto &a = row.figures.half_rise_s, &b = filter->figures.half_rise_s;
        good &= a && b && *a <= 0.5 * *b;
        if (a && b)
            found += fmt::format("{}{:.0f} ms for {:.0f} at {:.0f}", found.empty() ? "" : ", ", 1e3 * *a,
                                 1e3 * *b, row.rate_hz);
    }
    return {"from motion to half of the force at most half as long as with the filter, in the known fluid",
            found, good};
}

Goal closeness(const Study& study) {
    int more = 0, all = 0;
    double worst = 0.0;
    for (const CircleRow& row : study.circles) {
        const CircleRow* filter = other(study, row);
        if (row.law != ForceLaw::Model || !filter) continue;
        const double ratio = row.figures.rmse / filter->figures.rmse;
        ++all;
        more += ratio > 1.0;
        worst = std::max(worst, ratio);
    }
    return {"rmse against the fluid at 1 kHz no higher than the filter's",
            fmt::format("not so in {} of {} cases; {:.2f} of the filter's at the worst", more, all, worst),
            more == 0};
}

Goal energy(const Study& study) {
    int driven = 0, all = 0;
    double least = 1e9;
    for (const StirRow& row : study.stirs) {
        if (row.law != ForceLaw::Model) continue;
        ++all;
        driven += row.figures.least_cycle_j <= 0.0;
        if (row.figures.received_j > 0.0)
            least = std::min(least, row.figures.least_cycle_j / row.figures.received_j);
    }
    return {"in fluid at rest every cycle costs the hand energy, at 0.5 to 5 Hz",
            fmt::format("{} of {} runs; the cheapest cycle costs {:.2f} of what the fluid received in one",
                        all - driven, all, least),
            driven == 0};
}

Goal dearness(const Study& study) {
    double worst = 1.0, at_hz = 0.0, steadiest = 1.0;
    for (const StirRow& row : study.stirs) {
        if (row.law != ForceLaw::Model || !(row.figures.drag_j > 0.0)) continue;
        const double ratio = row.figures.mean_cycle_j / row.figures.drag_j;
        if (row.stir_hz <= 1.0) steadiest = std::max(steadiest, ratio);
        if (ratio <= worst) continue;
        worst = ratio;
        at_hz = row.stir_hz;
    }
    return {"and at most a fifth more than the work of such a drag, at 0.5 to 5 Hz",
            fmt::format("{:.2f} of it at the most, at {:g} Hz; up to 1 Hz {:.2f}", worst, at_hz, steadiest),
            worst <= 1.2};
}

Goal debt(const Study& study) {
    int all = 0, beyond = 0;
    double most = 0.0;
    for (const CircleRow& row : study.circles) {
        if (row.law != ForceLaw::Model || row.fluid == kKnown) continue;
        ++all;
        const double debt_j = -row.figures.report.least_j;
        beyond += debt_j > row.figures.stored_j;
        most = std::max(most, debt_j / std::max(1e-12, row.figures.stored_j));
    }
    return {"what the hand is given beyond the fluid's books stays within its kinetic energy",
            fmt::format("{} of {} runs; at most {:.2f} of it", all - beyond, all, most), beyond == 0};
}

Goal pull(const Study& study) {
    double worst = 0.0;
    for (const PullRow& row : study.pulls) worst = std::max(worst, row.error);
    return {"the mean pull of a jet comes through within 2 %",
            fmt::format("{:.2f} % off at the worst", 100.0 * worst), worst <= kPull};
}

Goal rest(const Study& study, bool known) {
    int swinging = 0, carried = 0, all = 0;
    std::string which;
    for (const SwingRow& row : study.swings) {
        if (row.law != ForceLaw::Model || (row.fluid == kKnown) != known || row.holder == Holder::Fixed)
            continue;
        ++all;
        const Swing &found = row.swing, &flow = row.carried;
        if (rests(found)) continue;
        if (rests(found, flow)) {
            ++carried;
            continue;
        }
        if (++swinging <= 4)
            which += fmt::format("{}{} {} at {:.0f}: {:.3f} N, {:.2f} mm, of the flow {:.3f} N, {:.2f} mm",
                                 which.empty() ? "; " : ", ", row.fluid, held_how(row), row.rate_hz,
                                 found.force_n, 1e3 * found.position_m, flow.force_n, 1e3 * flow.position_m);
    }
    if (swinging > 4) which += fmt::format(", and {} more", swinging - 4);
    return {
        fmt::format("the handle comes to rest (at most 0.05 N, 0.1 mm{}) held, held stiffly and let go, {}",
                    known ? "" : ", or twice what the flow by itself makes of it",
                    known ? "in a known fluid as steep as the gain is limited to" : "in every scene"),
        fmt::format("{} of {} runs{}{}", all - swinging, all,
                    carried > 0 ? fmt::format(", {} of them shaken by the flow", carried) : "", which),
        swinging == 0};
}

}  // namespace

std::vector<Goal> goals_of(const Study& study) {
    std::vector<Goal> goals{roughness(study, true)};
    const bool scenes = !study.fluids.empty();
    if (scenes) goals.push_back(roughness(study, false));
    goals.push_back(trembling(study));
    goals.push_back(latency(study));
    goals.push_back(closeness(study));
    goals.push_back(energy(study));
    goals.push_back(dearness(study));
    if (scenes) goals.push_back(debt(study));
    goals.push_back(pull(study));
    goals.push_back(rest(study, true));
    if (scenes) goals.push_back(rest(study, false));
    return goals;
}

}  // namespace eddy::haptic_study
