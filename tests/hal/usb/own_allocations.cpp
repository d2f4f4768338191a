#include "tests/hal/usb/own_allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/usb/bus.h"

namespace {
std::atomic<std::size_t> count{0};
}

void* operator new(std::size_t size) {
    if (!eddy::usb::InKernel::now()) ++count;
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}

namespace eddy {

std::size_t own_allocations() {
    return count;
}

}  // namespace eddy
