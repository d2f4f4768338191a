#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "hal/clock.h"

namespace eddy {

/// How long frames took, as counts up to bounds: what a histogram of Prometheus' is.
class FrameTimes {
  public:
    static constexpr std::array<double, 10> kBounds_s{0.01, 0.0167, 0.025, 0.0334, 0.05,
                                                      0.1,  0.2,    0.5,   1.0,    3.0};

    /// A picture came onto the screen.
    void shown(Instant now) {
        if (last_) add(now - *last_);
        last_ = now;
    }
    /// No more pictures for a while: what lies between this one and the next is no frame.
    void interrupted() { last_.reset(); }
    void add(Seconds frame) {
        std::size_t i = 0;
        while (i < kBounds_s.size() && frame.count() > kBounds_s[i]) ++i;
        ++counts_[i];
        sum_s_ += frame.count();
    }
    /// Frames that took bound i or less; of i = kBounds_s.size(), all.
    std::uint64_t up_to(std::size_t i) const {
        std::uint64_t all = 0;
        for (std::size_t j = 0; j <= i; ++j) all += counts_[j];
        return all;
    }
    double sum_s() const { return sum_s_; }

  private:
    std::array<std::uint64_t, kBounds_s.size() + 1> counts_{};
    double sum_s_ = 0.0;
    std::optional<Instant> last_;
};

}  // namespace eddy
