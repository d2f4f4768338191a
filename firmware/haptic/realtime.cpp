#include "firmware/haptic/realtime.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>
#include <fstream>

namespace eddy {
namespace {

void lock(const void* memory, std::size_t bytes, RealtimeGrant& grant) {
    if (mlock(memory, bytes) == 0)
        grant.locked_bytes += bytes;
    else if (grant.memory_error == 0)
        grant.memory_error = errno;
}

/// A page touched for the first time inside a tick costs a fault; this moves the faults to the start.
void lock_stack(RealtimeGrant& grant) {
    constexpr std::size_t kStack = 256 * 1024, kPage = 4096;
    volatile std::byte stack[kStack];
    for (std::size_t i = 0; i < kStack; i += kPage) stack[i] = std::byte{0};
    lock(const_cast<const std::byte*>(stack), kStack, grant);
}

bool kernel_is_realtime() {
    char answer = '0';  // the file exists only with PREEMPT_RT
    std::ifstream("/sys/kernel/realtime") >> answer;
    return answer == '1';
}

}  // namespace

RealtimeGrant grant_realtime(const MemoryPieces& memory) {
    RealtimeGrant grant{.realtime_kernel = kernel_is_realtime()};
    lock_stack(grant);
    for (const auto& piece : memory) lock(piece.data(), piece.size(), grant);
    sched_param parameters{};
    parameters.sched_priority = kHapticPriority;
    grant.fifo_error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
    grant.fifo = grant.fifo_error == 0;
    return grant;
}

std::string sentence_of(const RealtimeGrant& grant) {
    std::string said =
        grant.fifo
            ? fmt::format("the haptic thread runs at real-time priority (SCHED_FIFO {})", kHapticPriority)
            : fmt::format(
                  "the haptic thread has no real-time priority ({}): ticks come late when the machine is "
                  "busy; a service gets it by LimitRTPRIO={} in its unit",
                  std::strerror(grant.fifo_error), kHapticPriority);
    if (grant.memory_error == 0)
        return said + fmt::format("; its {:.1f} MB of memory are locked",
                                  1e-6 * static_cast<double>(grant.locked_bytes));
    return said +
           fmt::format("; not all of its memory is locked ({}): a service gets that by LimitMEMLOCK={}M",
                       std::strerror(grant.memory_error), kLockedMb);
}

}  // namespace eddy
