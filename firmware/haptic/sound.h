#pragma once
#include <cstring>
#include <limits>
#include <optional>

#include "hal/clock.h"

namespace eddy {

// Whether the bytes of a value are one at all. What was read from a file as bytes is asked this before anybody reads it as a
// value. (A double is always one; the law says what it thinks of those that are no number.)

inline bool is_sound(const bool& flag) {
    unsigned char byte = 0;
    std::memcpy(&byte, &flag, 1);
    return byte <= 1;
}
/// Times are added and subtracted: within a century of 0.
inline bool is_sound(const Instant& at) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max() / 4;
    return at.count() >= -kMost && at.count() <= kMost;
}
/// As libstdc++ and libc++ lay it out: the value, then whether there is one.
template <class T>
bool is_sound(const std::optional<T>& value) {
    static_assert(sizeof(value) == sizeof(T) + alignof(T));
    unsigned char byte = 0;
    std::memcpy(&byte, reinterpret_cast<const unsigned char*>(&value) + sizeof(T), 1);
    return byte <= 1;
}

}  // namespace eddy
