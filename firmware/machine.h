#pragma once
#include <string>

namespace eddy {

/// "model name, N cores, M GB" of the machine this runs on, for reports that quote times.
std::string describe_machine();

/// "2026-11-22 16:53", as it is in Greenwich.
std::string date_and_time();

}  // namespace eddy
