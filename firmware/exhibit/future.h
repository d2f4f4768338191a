#pragma once
#include <chrono>
#include <future>

namespace eddy {

/// Whether what was begun beside this thread has ended and waits to be fetched; false if nothing was, or it was fetched.
template <class T>
bool is_ready(const std::future<T>& future) {
    return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace eddy
