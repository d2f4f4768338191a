#pragma once
#include <chrono>
#include <future>

namespace eddy {

/// Does it on a thread of its own; where the system grants no more threads, when it is fetched: the show waits that once.
/// Takes a copy: libstdc++ moves what it may into the thread before it knows whether there will be one.
template <class Work>
auto beside(const Work& work) {
    return std::async(std::launch::async | std::launch::deferred, work);
}

/// Whether it goes on still.
template <class T>
bool is_under_way(const std::future<T>& future) {
    return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::timeout;
}

/// Whether what was begun beside this thread has ended and waits to be fetched; false if nothing was, or it was fetched.
template <class T>
bool is_ready(const std::future<T>& future) {
    return future.valid() && !is_under_way(future);
}

}  // namespace eddy
