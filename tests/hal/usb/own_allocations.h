#pragma once
#include <cstddef>

namespace eddy {

/// How often operator new was called since the program began, other than from within the emulated kernel.
std::size_t own_allocations();

}  // namespace eddy
