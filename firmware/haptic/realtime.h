#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace eddy {

/// Priority of the haptic thread under SCHED_FIFO: above ordinary threads, below the kernel's own
/// (ros2_control uses 50).
inline constexpr int kHapticPriority = 50;
/// More than enough of locked memory for the loop and what it keeps: ten megabytes.
inline constexpr int kLockedMb = 64;

/// What the system granted; start-up logs it. An error is an errno value, 0 if granted.
struct RealtimeGrant {
    bool fifo = false;             ///< the calling thread runs under SCHED_FIFO at kHapticPriority
    int fifo_error = 0;            ///< EPERM: raise LimitRTPRIO= in the unit
    std::size_t locked_bytes = 0;  ///< never swapped out
    int memory_error = 0;          ///< ENOMEM or EPERM: raise LimitMEMLOCK= in the unit
    bool realtime_kernel = false;
};
/// For the log, in one line; with what to do about what was refused.
std::string sentence_of(const RealtimeGrant& grant);

/// Memory that a tick reads or writes.
using MemoryPieces = std::vector<std::span<const std::byte>>;

/// Asks for real time for the calling thread, and locks its stack and `memory`, all of which is there from then on. Not the whole
/// process (mlockall): a GL driver maps gigabytes, which would count against the limit, and once that is reached nothing can
/// be allocated any more. Never fails: the loop runs without, and counts its late ticks.
RealtimeGrant grant_realtime(const MemoryPieces& memory);

}  // namespace eddy
