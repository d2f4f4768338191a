#pragma once
#include <cstdint>

namespace eddy {

/// How often operator new has been called in this program, by any thread.
std::uint64_t allocations();

}  // namespace eddy
