#pragma once
#include <cstddef>

namespace eddy {

/// How often operator new was called since the program began, by anybody.
std::size_t allocations();

}  // namespace eddy
