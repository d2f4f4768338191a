#pragma once

namespace eddy {

/// Priority of the haptic thread under SCHED_FIFO: above ordinary threads, below the kernel's own
/// (ros2_control uses 50).
inline constexpr int kHapticPriority = 50;

/// What the system granted; start-up logs it. An error is an errno value, 0 if granted or not asked for.
struct RealtimeGrant {
    bool fifo = false;           ///< the calling thread runs under SCHED_FIFO at kHapticPriority
    int fifo_error = 0;          ///< EPERM: raise LimitRTPRIO= in the unit
    bool memory_locked = false;  ///< no page of the process is swapped out once touched
    int memory_error = 0;        ///< ENOMEM or EPERM: raise LimitMEMLOCK= in the unit
    bool realtime_kernel = false;
};

enum class MemoryLock { No, Yes };

/// Asks for real time for the calling thread and touches its stack in advance. Never fails: the loop runs
/// without, and counts its late ticks. `memory` locks pages as they are touched (MCL_ONFAULT), so a GL
/// driver's unused ones cost nothing.
RealtimeGrant grant_realtime(MemoryLock memory);

}  // namespace eddy
