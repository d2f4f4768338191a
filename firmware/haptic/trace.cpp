#include "firmware/haptic/trace.h"

namespace eddy {

void TickTrace::push(const TickRecord& tick) {
    const std::size_t place = in_.load(std::memory_order_relaxed);
    const std::size_t next = after(place);
    if (next == out_.load(std::memory_order_acquire)) {
        dropped_.fetch_add(1, std::memory_order_relaxed);
        return;
    }
    ring_[place] = tick;
    in_.store(next, std::memory_order_release);
}

std::size_t TickTrace::drain(std::span<TickRecord> out) {
    const std::size_t end = in_.load(std::memory_order_acquire);
    std::size_t place = out_.load(std::memory_order_relaxed);
    std::size_t count = 0;
    for (; count < out.size() && place != end; place = after(place)) out[count++] = ring_[place];
    out_.store(place, std::memory_order_release);
    return count;
}

}  // namespace eddy
