#pragma once
#include <array>
#include <cstddef>

namespace eddy::emulated {

/// A queue of at most N things that never allocates.
template <typename T, std::size_t N>
class Ring {
  public:
    bool empty() const { return size_ == 0; }
    bool full() const { return size_ == N; }
    std::size_t size() const { return size_; }
    void clear() { size_ = 0; }
    const T& front() const { return items_[first_]; }
    T pop() {
        const T item = items_[first_];
        first_ = (first_ + 1) % N;
        --size_;
        return item;
    }
    /// False, and the item is lost, if the queue is full.
    bool push(const T& item) {
        if (full()) return false;
        items_[(first_ + size_) % N] = item;
        ++size_;
        return true;
    }

  private:
    std::array<T, N> items_{};
    std::size_t first_ = 0;
    std::size_t size_ = 0;
};

}  // namespace eddy::emulated
