#pragma once
#include <cstdint>

namespace eddy {

/// How often operator new has been called in this program, by any thread, but for what ignore_allocations() leaves out.
std::uint64_t allocations();
/// From now on none counts that is made while this is true of its thread.
void ignore_allocations(bool (*while_this)());

}  // namespace eddy
