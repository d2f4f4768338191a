#pragma once
#include <optional>
#include <string_view>

#include "hal/clock.h"

namespace eddy {

/// How long ago the kernel started this process, by the kernel's own clock in steps of 10 ms: what a start takes, the program's loading
/// included. None where the kernel does not tell.
std::optional<Seconds> process_age();

/// When a process was started, of the text of its /proc/PID/stat: in ticks since the machine's start. None if it is no such text.
std::optional<long long> start_ticks(std::string_view stat);

}  // namespace eddy
