#include "firmware/force_ripple.h"

namespace eddy {
namespace {

constexpr double kHalfMeanS = 0.1;        // of the moving mean, to each side
constexpr double kWindowS = 2.0;          // of the rms
constexpr double kGapS = 2 * kHalfMeanS;  // a mean over more than it spans would be made up
constexpr std::size_t kCapacity = 2300;   // 2.2 s, and a little, of a force every millisecond
constexpr std::size_t kFewestLeft = 24;   // of what the mean leaves, before it is called an rms
constexpr double kRounding = 1e-9;        // of times, in s

/// The force on the way from one sample to the next.
template <class Sample>
glm::dvec3 between(const Sample& a, const Sample& b, double time_s) {
    return glm::mix(a.force, b.force, (time_s - a.time_s) / (b.time_s - a.time_s));
}

}  // namespace

ForceRipple::ForceRipple() : ring_(kCapacity) {}

void ForceRipple::add(Seconds time, const glm::dvec3& force) {
    const double t = time.count();
    if (count_ > 0) {
        const double since = t - at(count_ - 1).time_s;
        if (!(since > 0.0) || since > kGapS) reset();
    }
    // What neither the window nor the mean at its beginning needs goes; one more, from which the line comes.
    const double needed = t - kWindowS - 2 * kHalfMeanS;
    while (count_ == ring_.size() || (count_ > 1 && at(1).time_s <= needed)) {
        first_ = (first_ + 1) % ring_.size();
        --count_;
    }
    ring_[(first_ + count_) % ring_.size()] = {t, force};
    ++count_;
}

std::optional<ForceRipple::Figures> ForceRipple::figures() const {
    if (count_ < kFewestLeft) return std::nullopt;
    const double oldest = at(0).time_s - kRounding, newest = at(count_ - 1).time_s + kRounding;
    // The integral of the force from the oldest sample to a moment; moments come in order, and `next` goes along.
    struct Integral {
        const ForceRipple& of;
        std::size_t next = 1;
        glm::dvec3 sum{0.0};  // up to the sample before `next`
        glm::dvec3 to(double time_s) {
            while (next + 1 < of.count_ && of.at(next).time_s <= time_s) {
                sum += 0.5 * (of.at(next).time_s - of.at(next - 1).time_s) *
                       (of.at(next - 1).force + of.at(next).force);
                ++next;
            }
            const Sample &a = of.at(next - 1), &b = of.at(next);
            return sum + 0.5 * (time_s - a.time_s) * (a.force + between(a, b, time_s));
        }
    };
    Integral lower{*this}, upper{*this};
    double left = 0.0, whole = 0.0;
    std::size_t n = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        const double t = at(i).time_s;
        if (t - kHalfMeanS < oldest) continue;
        if (t + kHalfMeanS > newest) break;
        const glm::dvec3 mean = (upper.to(t + kHalfMeanS) - lower.to(t - kHalfMeanS)) / (2 * kHalfMeanS);
        const glm::dvec3 rest = at(i).force - mean;
        left += glm::dot(rest, rest);
        whole += glm::length(at(i).force);
        ++n;
    }
    if (n < kFewestLeft) return std::nullopt;
    const auto count = static_cast<double>(n);
    Figures figures;
    figures.rms = std::sqrt(left / count);
    if (whole > 0.0) figures.share = figures.rms / (whole / count);
    return figures;
}

}  // namespace eddy
