#include "firmware/haptic/loop.h"

#include <algorithm>

namespace eddy {
namespace {

/// How late the fluid's answers are is smoothed over about so many.
constexpr double kLatenessMemory = 8.0;
/// What comes later than this was held up by something else, a shader or a scene that was made ready.
constexpr Seconds kStandstill{0.25};

}  // namespace

HapticLoop::HapticLoop(HapticDevice& device, HapticExchange& exchange, TickTrace& trace,
                       const HapticLoopSettings& settings, FlightRecorder* flights,
                       const StopInput* stop_input)
    : device_(device),
      exchange_(exchange),
      trace_(trace),
      flights_(flights),
      stop_input_(stop_input),
      state_(hand_state(settings)) {}

MemoryPieces HapticLoop::memory() const {
    MemoryPieces pieces{std::as_bytes(std::span(this, 1)), std::as_bytes(std::span(&exchange_, 1)),
                        trace_.memory()};
    if (!flights_) return pieces;
    const MemoryPieces more = flights_->memory();
    pieces.insert(pieces.end(), more.begin(), more.end());
    return pieces;
}

void HapticLoop::tick(Instant now) {
    const Instant step = report_.ticks > 0 ? now - last_ : kTick;
    last_ = now;

    device_.poll(now);
    HapticInput in{.now = now,
                   .reading = device_.read(),
                   .device = device_.state(),
                   .obeys = device_.obeys(),
                   .silence = device_.silence(now),
                   .fluid = exchange_.fluid.newest(),
                   .orders = exchange_.orders.newest()};
    if (closing_) in.orders.enabled = false;
    // An order like any other from here on: the flight recorder keeps it, and a rerun obeys it.
    if (stop_input_ && stop_input_->pressed(now)) in.orders.stop = true;

    if (flights_) flights_->begin_tick(state_);
    const LawOutput out = hand_tick(state_, in, step);
    if (const auto& light = exchange_.light.newest()) device_.show(*light);
    device_.command(out.force_n);
    if (flights_) flights_->end_tick(step, in, out);
    exchange_.pose.publish(out.pose);

    trace_.push({.t = now,
                 .position_m = state_.law.hand.position_m(),
                 .velocity_m_s = state_.law.hand.velocity_m_s(),
                 .raw_force_n = out.raw_n,
                 .filtered_force_n = out.filtered_n,
                 .sent_force_n = out.force_n,
                 .fluid_sequence = in.fluid.sequence,
                 .fluid_age = out.fluid_age,
                 .fluid_lag = now - in.fluid.computed_for,
                 .reason = out.reason,
                 .buttons = out.pose.buttons});
    ++report_.ticks;
    const Seconds lateness = now - in.fluid.computed_for;
    if (in.fluid.sequence != 0 && out.fluid_age == Instant(0) && lateness < kStandstill)  // it has just come
        report_.fluid_lateness += (lateness - report_.fluid_lateness) / kLatenessMemory;
    report_.impulses = state_.law.force.impulses();
    report_.force = state_.law.force.report();
    report_.gate = state_.law.gate.counters();
    report_.hand = state_.dead_man.counters();
    if (!closing_) report_.reason = out.reason;  // the last word of a run is not that it ended
    report_.device = in.device;
    report_.device_counters = device_.counters();
    exchange_.report.publish(report_);
}

void HapticLoop::run(Clock& clock, const std::atomic<bool>& stop) {
    closing_ = false;
    Instant due = clock.now();
    while (!stop.load(std::memory_order_relaxed)) due = pace(clock, due);
    closing_ = true;
    for (int i = 0; i < kClosingTicks; ++i) due = pace(clock, due);
}

/// Runs one tick for the last grid point that has come, `due` if all goes well, and returns the grid point
/// for the next: the one after it, or a later one if the tick took long.
Instant HapticLoop::pace(Clock& clock, Instant due) {
    clock.sleep_until(due);
    const Instant now = clock.now();
    const Instant late = now - due;
    const auto passed = late / kTick;
    if (late > kLate) ++report_.late;
    report_.missed += static_cast<std::uint64_t>(passed);
    report_.worst_late = std::max(report_.worst_late, late);
    tick(now);
    const Instant step = device_.state() == HapticState::Absent ? kAbsentTick : kTick;
    const Instant next = due + passed * kTick + step;
    const Instant took = clock.now() - now;
    const auto given = std::max<std::int64_t>((now + 2 * took - next + kTick - Instant(1)) / kTick, 0);
    report_.missed += static_cast<std::uint64_t>(given);
    return next + given * kTick;
}

}  // namespace eddy
