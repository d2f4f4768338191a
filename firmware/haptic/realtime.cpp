#include "firmware/haptic/realtime.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstddef>
#include <fstream>

namespace eddy {
namespace {

/// A page touched for the first time inside a tick costs a fault; this moves the faults to the start.
void touch_stack() {
    constexpr std::size_t kStack = 256 * 1024, kPage = 4096;
    volatile char stack[kStack];
    for (std::size_t i = 0; i < kStack; i += kPage) stack[i] = 0;
    static_cast<void>(stack[0]);
}

bool kernel_is_realtime() {
    char answer = '0';  // the file exists only with PREEMPT_RT
    std::ifstream("/sys/kernel/realtime") >> answer;
    return answer == '1';
}

}  // namespace

RealtimeGrant grant_realtime(MemoryLock memory) {
    RealtimeGrant grant{.realtime_kernel = kernel_is_realtime()};
    if (memory == MemoryLock::Yes) {
        grant.memory_locked = mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0;
        if (!grant.memory_locked) grant.memory_error = errno;
    }
    sched_param parameters{};
    parameters.sched_priority = kHapticPriority;
    grant.fifo_error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    grant.fifo = grant.fifo_error == 0;
    touch_stack();
    return grant;
}

}  // namespace eddy
