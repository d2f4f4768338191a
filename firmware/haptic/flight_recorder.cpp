#include "firmware/haptic/flight_recorder.h"

namespace eddy {

FlightRecorder::FlightRecorder(const HapticLoopSettings& settings) : settings_(settings) {}

void FlightRecorder::begin_tick(const HandState& state) {
    Store& store = stores_[writing_];
    if (store.segments[store.newest].count == kSegmentTicks) {
        store.newest = (store.newest + 1) % store.segments.size();
        store.segments[store.newest].count = 0;
    }
    Segment& segment = store.segments[store.newest];
    if (segment.count == 0) segment.start = state;
}

void FlightRecorder::end_tick(Instant step, const HapticInput& in, const LawOutput& out) {
    Store& store = stores_[writing_];
    Segment& segment = store.segments[store.newest];
    segment.ticks[segment.count++] = {step, in, out};
    watch(in, out);
    if (after_ && ticks_left_-- == 0) hand_over();
}

void FlightRecorder::watch(const HapticInput& in, const LawOutput& out) {
    if (out.reason <= GateReason::Starting) felt_.fill(true);
    const auto kind = static_cast<std::size_t>(out.reason);
    if (!is_fault(out.reason) || !felt_[kind]) return;
    felt_[kind] = false;
    // A fault that follows from another is kept with it. Trouble with the device gives its name to both; what was lost is
    // silent too, and keeps the first.
    constexpr GateReason kOfTheDevice = GateReason::DeviceNotReady;
    if (after_ && (out.reason < kOfTheDevice || stores_[writing_].cause >= kOfTheDevice)) return;
    std::optional<Instant>& last = last_[kind];
    if (last && in.now - *last < kQuiet) return;
    last = in.now;
    after_ = true;
    ticks_left_ = kAfterTicks;
    stores_[writing_].cause = out.reason;
    stores_[writing_].at = in.now;
}

void FlightRecorder::hand_over() {
    after_ = false;
    if (handed_.load(std::memory_order_acquire)) {
        lost_.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    handed_.store(&stores_[writing_], std::memory_order_release);
    writing_ = 1 - writing_;
    for (Segment& segment : stores_[writing_].segments) segment.count = 0;
}

std::optional<Flight> FlightRecorder::take() {
    const Store* store = handed_.load(std::memory_order_acquire);
    if (!store) return std::nullopt;
    Flight flight = copy(*store);
    handed_.store(nullptr, std::memory_order_release);
    return flight;
}

std::optional<Flight> FlightRecorder::take_unfinished() {
    if (!after_) return std::nullopt;
    after_ = false;
    return copy(stores_[writing_]);
}

Flight FlightRecorder::copy(const Store& store) const {
    Flight flight;
    flight.cause = store.cause;
    flight.at = store.at;
    flight.settings = settings_;
    const std::size_t segments = store.segments.size();
    for (std::size_t i = 1; i <= segments; ++i) {
        const Segment& segment = store.segments[(store.newest + i) % segments];
        if (segment.count > 0 && flight.ticks.empty()) flight.start = segment.start;
        flight.ticks.insert(flight.ticks.end(), segment.ticks.begin(),
                            segment.ticks.begin() + static_cast<std::ptrdiff_t>(segment.count));
    }
    return flight;
}

}  // namespace eddy
