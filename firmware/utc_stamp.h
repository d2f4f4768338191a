#pragma once
#include <string>

namespace eddy {

/// The time by the machine's clock, UTC: as ISO 8601 has it, or as strftime() makes it of another `format`.
std::string utc_stamp(const char* format = "%Y-%m-%dT%H:%M:%SZ");

}  // namespace eddy
