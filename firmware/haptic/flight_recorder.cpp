#include "firmware/haptic/flight_recorder.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace eddy {
namespace {

/// Before the settings and the segments; all as this build lays them out.
struct RawHead {
    char magic[16] = "eddy raw flight";
    std::uint64_t tick_bytes = sizeof(FlightTick), state_bytes = sizeof(HandState),
                  settings_bytes = sizeof(HapticLoopSettings);
    std::uint64_t segments = 0;
};
static_assert(std::is_trivially_copyable_v<FlightTick> && std::is_trivially_copyable_v<HapticLoopSettings>);

bool write_all(int fd, const void* bytes, std::size_t size) {
    const char* at = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t written = ::write(fd, at, size);
        if (written <= 0) return false;
        at += written;
        size -= static_cast<std::size_t>(written);
    }
    return true;
}

/// Takes `size` bytes off the front into `to`.
bool take_off(std::string_view& bytes, void* to, std::size_t size) {
    if (bytes.size() < size) return false;
    std::memcpy(to, bytes.data(), size);
    bytes.remove_prefix(size);
    return true;
}

}  // namespace

FlightRecorder::FlightRecorder(const HapticLoopSettings& settings) : settings_(settings) {}

MemoryPieces FlightRecorder::memory() const {
    MemoryPieces pieces{std::as_bytes(std::span(this, 1))};
    for (const Store& store : stores_)
        for (const Segment& segment : store.segments)
            pieces.push_back(std::as_bytes(std::span(segment.ticks)));
    return pieces;
}

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

void FlightRecorder::write_raw(int fd) const noexcept {
    const Store& store = stores_[std::min<std::size_t>(writing_, 1)];
    RawHead head;
    head.segments = store.segments.size();
    if (!write_all(fd, &head, sizeof(head)) || !write_all(fd, &settings_, sizeof(settings_))) return;
    for (std::size_t i = 1; i <= store.segments.size(); ++i) {
        const Segment& segment = store.segments[(store.newest + i) % store.segments.size()];
        const std::uint64_t count = std::min(segment.count, kSegmentTicks);
        if (!write_all(fd, &count, sizeof(count)) || !write_all(fd, &segment.start, sizeof(segment.start)) ||
            !write_all(fd, segment.ticks.data(), count * sizeof(FlightTick)))
            return;
    }
}

std::optional<Flight> FlightRecorder::read_raw(std::string_view bytes) {
    const RawHead mine;
    RawHead head;
    Flight flight;
    if (!take_off(bytes, &head, sizeof(head)) ||
        std::memcmp(head.magic, mine.magic, sizeof(mine.magic)) != 0 || head.tick_bytes != mine.tick_bytes ||
        head.state_bytes != mine.state_bytes || head.settings_bytes != mine.settings_bytes ||
        !take_off(bytes, &flight.settings, sizeof(flight.settings)))
        return std::nullopt;
    for (std::uint64_t i = 0; i < head.segments; ++i) {
        std::uint64_t count = 0;
        HandState start{};
        if (!take_off(bytes, &count, sizeof(count)) || !take_off(bytes, &start, sizeof(start)) ||
            count > kSegmentTicks)
            return std::nullopt;
        if (count > 0 && flight.ticks.empty()) flight.start = start;
        for (std::uint64_t n = 0; n < count; ++n) {
            FlightTick tick;
            if (!take_off(bytes, &tick, sizeof(tick))) return std::nullopt;
            flight.ticks.push_back(tick);
        }
    }
    if (flight.ticks.empty() || !bytes.empty()) return std::nullopt;
    flight.cause = flight.ticks.back().out.reason;
    flight.at = flight.ticks.back().in.now;
    return flight;
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
