#include "firmware/haptic_study/trials.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/haptic/dead_man.h"
#include "firmware/haptic_study/paths.h"

namespace eddy::haptic_study {
namespace {

/// After the soft start of the force, and when the model has seen most of a turn. [ms]
constexpr std::size_t kCircleFrom = 1500, kCircleTo = 2500;
constexpr std::size_t kGoAt = 3200, kGoTo = 3500;

Path circle_path() {
    return stir_then_go(Seconds(1e-3 * kCircleTo), Seconds(1e-3 * kGoAt), 0.1);
}

std::vector<glm::dvec3> forces(const Play& play, std::size_t from, std::size_t to) {
    std::vector<glm::dvec3> all;
    for (std::size_t i = from; i < std::min(to, play.ticks.size()); ++i) all.push_back(play.ticks[i].force_n);
    return all;
}

/// Of the work of a drag on a circle, what a fluid receives that sees the circle as chords: its velocity is shorter by
/// sinc(f / fs), and the work is counted over the mean of two chords, an angle of 2 pi f / fs apart, which is cos^2(pi f / fs) more.
double seen_of_drag(double stir_hz, double rate_hz) {
    const double half_turn = std::numbers::pi * stir_hz / rate_hz;
    return std::pow(std::sin(half_turn) / half_turn * std::cos(half_turn), 2);
}

}  // namespace

std::vector<glm::dvec3> reference_forces(StudyFluid& fluid) {
    Handle handle(Holder::Fixed, circle_path(), Reading::Exact);
    const Play seen =
        play(fluid, handle,
             {.law = ForceLaw::Filter, .rate_hz = 1000.0, .duration = Seconds(1e-3 * (kCircleTo + 5))});
    std::vector<glm::dvec3> all(kCircleTo, glm::dvec3(0.0));
    for (const FluidSnapshot& answer : seen.answers) {
        const auto tick = static_cast<std::size_t>(answer.computed_for / kTick);
        if (tick < all.size()) all[tick] = answer.force_n;
    }
    return all;
}

CircleFigures circle_figures(StudyFluid& fluid, ForceLaw law, double rate_hz,
                             const std::vector<glm::dvec3>& reference) {
    Handle handle(Holder::Fixed, circle_path());
    const Play tried =
        play(fluid, handle, {.law = law, .rate_hz = rate_hz, .duration = Seconds(1e-3 * kGoTo)});
    CircleFigures f{.felt = forces(tried, kCircleFrom, kCircleTo)};
    std::vector<glm::dvec3> off;
    for (std::size_t i = 0; i < f.felt.size(); ++i) {
        f.reference.push_back(tried.orders.gain * reference.at(kCircleFrom + i));
        off.push_back(f.felt[i] - f.reference[i]);
    }
    f.force_n = rms(f.reference);
    f.roughness = trembling(off) / f.force_n;
    f.trembling = trembling(f.felt) / rms(f.felt);
    f.reference_trembling = trembling(f.reference) / f.force_n;
    f.rmse = rms(off) / f.force_n;
    f.lag_s = lag_s(f.felt, f.reference);
    f.half_rise_s = half_rise_s(forces(tried, kGoAt, kGoTo));
    f.report = tried.report.force;
    for (const FluidSnapshot& answer : tried.answers)
        f.stored_j =
            std::max(f.stored_j, answer.stored_j * tried.orders.gain / tried.orders.tank_from_device.scale);
    f.damped = static_cast<double>(f.report.damped) / static_cast<double>(tried.ticks.size());
    return f;
}

StirFigures stir_figures(StudyFluid& fluid, ForceLaw law, double rate_hz, double stir_hz) {
    constexpr double kFromS = 2.0, kForS = 2.0;
    Handle handle(Holder::Fixed, circle(stir_hz));
    const Play tried =
        play(fluid, handle, {.law = law, .rate_hz = rate_hz, .duration = Seconds(kFromS + kForS + 0.001)});
    const auto cycles = static_cast<std::size_t>(std::lround(kForS * stir_hz));
    const auto length = static_cast<std::size_t>(std::lround(1000.0 / stir_hz));
    StirFigures f;
    for (std::size_t n = 0; n < cycles; ++n) {
        const double cycle_j =
            spent_j(std::span(tried.ticks)
                        .subspan(static_cast<std::size_t>(1000.0 * kFromS) + n * length, length + 1));
        f.least_cycle_j = n == 0 ? cycle_j : std::min(f.least_cycle_j, cycle_j);
        f.mean_cycle_j += cycle_j / static_cast<double>(cycles);
    }
    const auto after = std::find_if(tried.answers.begin(), tried.answers.end(), [](const FluidSnapshot& a) {
        return Seconds(a.computed_for).count() >= kFromS;
    });
    if (after != tried.answers.end()) {
        const FluidSnapshot &first = *after, &last = tried.answers.back();
        const double turns = Seconds(last.computed_for - first.computed_for).count() * stir_hz;
        f.received_j = (last.received_j - first.received_j) * tried.orders.gain /
                       tried.orders.tank_from_device.scale / turns;
        f.drag_j = f.received_j / seen_of_drag(stir_hz, rate_hz);
    }
    return f;
}

std::vector<Felt> coming_to_rest(StudyFluid& fluid, ForceLaw law, double rate_hz, Holder holder,
                                 double stir_hz) {
    constexpr Seconds kUntil{1.4};
    const bool goes = holder == Holder::LetsGo;
    // Time to be carried to a wall by whatever flows.
    const Seconds duration(goes ? 7.0 : 3.9);
    Handle handle(holder, goes ? circle(stir_hz) : stir_then_leap(kUntil));
    return play(fluid, handle,
                {.law = law,
                 .rate_hz = rate_hz,
                 .duration = duration,
                 .let_go = goes ? std::optional(kUntil) : std::nullopt})
        .ticks;
}

std::vector<Felt> fixed_there(StudyFluid& fluid, ForceLaw law, double rate_hz, std::span<const Felt> rested) {
    const std::span<const Felt> end = rested.last(1000);
    glm::dvec3 there_m(0.0);
    for (const Felt& tick : end) there_m += tick.position_m / static_cast<double>(end.size());
    Handle handle(Holder::Fixed, [=](Seconds) { return there_m; });
    // No longer, or the loop takes a handle that does not even tremble for one that nobody holds, and gives no force.
    constexpr Seconds kStillHeld = DeadMan::kStillFor - Seconds(0.1);
    const Seconds duration(std::min(1e-3 * static_cast<double>(rested.size()), kStillHeld.count()));
    return play(fluid, handle, {.law = law, .rate_hz = rate_hz, .duration = duration}).ticks;
}

Swing swing_figures(std::span<const Felt> ticks) {
    return swing(ticks.last(1000));
}

Swing carried_figures(std::span<const Felt> fixed, Holder holder) {
    const std::span<const Felt> felt = fixed.last(2000);  // half a second after the leap
    glm::dvec3 mean_n(0.0);
    for (const Felt& tick : felt) mean_n += tick.force_n / static_cast<double>(felt.size());
    Handle handle(
        holder, [](Seconds) { return glm::dvec3(0.0); }, Reading::Exact);
    if (holder == Holder::LetsGo) handle.let_go();
    std::vector<Felt> moved;
    Instant now{0};
    for (const Felt& tick : felt) {
        handle.command(tick.force_n - mean_n);
        handle.poll(now += kTick);
        moved.push_back({handle.position_m(), tick.force_n});
    }
    return swing_figures(moved);
}

double pull_error(StudyFluid& fluid, double rate_hz) {
    constexpr std::size_t kFrom = 3000, kTo = 4000;  // [ms]
    Handle handle(Holder::Arm, [](Seconds) { return glm::dvec3(0.0); });
    const Play tried =
        play(fluid, handle, {.law = ForceLaw::Model, .rate_hz = rate_hz, .duration = Seconds(1e-3 * kTo)});
    const std::vector<glm::dvec3> felt = forces(tried, kFrom, kTo);
    glm::dvec3 felt_n(0.0), given_n(0.0);
    for (const glm::dvec3& force_n : felt) felt_n += force_n / static_cast<double>(felt.size());
    double count = 0.0;
    for (const FluidSnapshot& answer : tried.answers) {
        // What it gives reaches the hand a period later.
        if (Seconds(answer.computed_for).count() + 1.0 / rate_hz < 1e-3 * kFrom) continue;
        given_n += tried.orders.gain * answer.force_n;
        ++count;
    }
    return count > 0.0 ? pull_error(felt_n, given_n / count) : 1.0;
}

}  // namespace eddy::haptic_study
