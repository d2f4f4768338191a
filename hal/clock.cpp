#include "hal/clock.h"

#include <time.h>

#include <cerrno>

namespace eddy {

RealClock::RealClock() : start_(std::chrono::steady_clock::now()) {}

Instant RealClock::now() const {
    return std::chrono::steady_clock::now() - start_;
}

void RealClock::sleep_until(Instant t) {
    // std::this_thread::sleep_until turns an absolute time into a relative one; the kernel's absolute sleep
    // does not.
    const auto since_epoch = (start_ + t).time_since_epoch();
    const auto whole = std::chrono::duration_cast<std::chrono::seconds>(since_epoch);
    const timespec until{whole.count(), std::chrono::nanoseconds(since_epoch - whole).count()};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
}

}  // namespace eddy
