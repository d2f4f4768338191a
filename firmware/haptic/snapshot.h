#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace eddy {

/// Hands whole values from one thread to one other; the newest wins and nobody ever waits. Three slots: the
/// writer owns one, the reader owns one, the third lies between them and changes hands by a single atomic
/// exchange, so no value is ever read while it is written. Before the first publish() the reader sees a
/// value-initialised T.
template <class T>
class Snapshot {
    static_assert(std::is_trivially_copyable_v<T>);
    static_assert(std::atomic<std::uint8_t>::is_always_lock_free);

  public:
    /// Writer's thread only.
    void publish(const T& value) {
        slots_[writing_].value = value;
        // release: the value is complete before it can be taken; acquire: the reader is done with the slot
        // that comes back.
        writing_ = between_.exchange(writing_ | kFresh, std::memory_order_acq_rel) & kSlot;
    }

    /// Reader's thread only. The reference stays valid and unchanged until the next call.
    const T& newest() {
        if (between_.load(std::memory_order_relaxed) & kFresh)
            reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & kSlot;
        return slots_[reading_].value;
    }

  private:
    static constexpr std::uint8_t kSlot = 3, kFresh = 4;
    static constexpr std::size_t kCacheLine = 64;  // keeps the two threads off each other's lines

    struct alignas(kCacheLine) Slot {
        T value{};
    };
    std::array<Slot, 3> slots_{};
    alignas(kCacheLine) std::atomic<std::uint8_t> between_{1};
    alignas(kCacheLine) std::uint8_t writing_ = 0;
    alignas(kCacheLine) std::uint8_t reading_ = 2;
};

}  // namespace eddy
