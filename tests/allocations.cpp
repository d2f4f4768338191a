#include "tests/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<std::uint64_t> counted_allocations{0};
std::atomic<bool (*)()> ignored_while{nullptr};
}  // namespace

// The array and nothrow forms of the library call these two.
void* operator new(std::size_t size) {
    bool (*const ignored)() = ignored_while;
    if (!ignored || !ignored()) ++counted_allocations;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace eddy {

std::uint64_t allocations() {
    return counted_allocations;
}

void ignore_allocations(bool (*while_this)()) {
    ignored_while = while_this;
}

}  // namespace eddy
