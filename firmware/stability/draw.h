#pragma once
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <initializer_list>
#include <random>

namespace eddy::stability {

/// Draws from a seed alike everywhere: the distributions of the standard library are not.
class Draw {
  public:
    explicit Draw(std::uint64_t seed) : random_(seed) {}

    double share() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
    bool chance(double p) { return share() < p; }
    double between(double low, double high) { return low + (high - low) * share(); }
    /// Every order of magnitude as likely.
    double scale(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    int whole(int low, int high) { return low + static_cast<int>(share() * (high - low + 1)); }
    /// One of them.
    template <class T>
    T one_of(std::initializer_list<T> choices) {
        return choices.begin()[static_cast<std::size_t>(share() * static_cast<double>(choices.size()))];
    }
    /// Components within +-most.
    glm::dvec3 vector(double most) {
        const double z = between(-most, most), y = between(-most, most);
        return {between(-most, most), y, z};
    }

  private:
    std::mt19937_64 random_;
};

}  // namespace eddy::stability
