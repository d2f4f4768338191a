#include "firmware/haptic/exponential.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace eddy {
namespace {

/// e^-x = halved * (1 + more), with halved a power of two and |more| < 0.42.
struct Parts {
    double halved, more;
};

/// For 0 < x < 1000. ln 2 in two pieces, the first of which has so few digits that its multiples are exact (W. J. Cody and
/// W. Waite, Software Manual for the Elementary Functions, 1980; the pieces are those of fdlibm's e_exp.c).
Parts parts_of(double x) {
    constexpr double kHigh = 6.93147180369123816490e-01, kLow = 1.90821492927058770002e-10,
                     kPerLn2 = 1.44269504088896338700;
    const int n = static_cast<int>(kPerLn2 * x + 0.5);
    const double y = (n * kHigh - x) + n * kLow;  // |y| <= ln 2 / 2
    // The series of e^y - 1; what is left out is y^15 / 15! < 1e-19.
    constexpr int kTerms = 14;
    double sum = 1.0;
    for (int k = kTerms; k > 1; --k) sum = 1.0 + y / k * sum;
    constexpr int kBias = 1023, kFractionBits = 52;
    const double halved =
        n < kBias ? std::bit_cast<double>(static_cast<std::uint64_t>(kBias - n) << kFractionBits) : 0.0;
    return {halved, y * sum};
}

constexpr double kAllGone = 1000.0;

}  // namespace

double left_of(double x) {
    if (std::isnan(x)) return x;
    if (!(x > 0.0)) return 1.0;
    if (x >= kAllGone) return 0.0;
    const Parts e = parts_of(x);
    return e.halved + e.halved * e.more;
}

double gone_of(double x) {
    if (std::isnan(x)) return x;
    if (!(x > 0.0)) return 0.0;
    if (x >= kAllGone) return 1.0;
    const Parts e = parts_of(x);
    return (1.0 - e.halved) - e.halved * e.more;
}

}  // namespace eddy
