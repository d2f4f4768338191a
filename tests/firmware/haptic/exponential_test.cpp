#include "firmware/haptic/exponential.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace eddy {
namespace {

/// Units of the last place between two that are not below 0.
std::uint64_t apart(double a, double b) {
    const auto x = std::bit_cast<std::uint64_t>(a), y = std::bit_cast<std::uint64_t>(b);
    return x > y ? x - y : y - x;
}

TEST(Exponential, IsThatOfTheLibraryWithinTwoUnitsOfTheLastPlace) {
    std::uint64_t left = 0, gone = 0;
    for (double x = 1e-18; x < 700.0; x *= 1.0003) {
        left = std::max(left, apart(left_of(x), std::exp(-x)));
        gone = std::max(gone, apart(gone_of(x), -std::expm1(-x)));
    }
    EXPECT_LE(left, 2U);
    EXPECT_LE(gone, 2U);
}

TEST(Exponential, BeginsAtOneAndEndsAtNothing) {
    const double infinity = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();
    for (const double x : {0.0, -0.0, -3.0, -infinity}) {
        EXPECT_EQ(left_of(x), 1.0);
        EXPECT_EQ(gone_of(x), 0.0);
    }
    for (const double x : {800.0, 1e4, 1e300, infinity}) {
        EXPECT_EQ(left_of(x), 0.0);
        EXPECT_EQ(gone_of(x), 1.0);
    }
    EXPECT_TRUE(std::isnan(left_of(nan)));
    EXPECT_TRUE(std::isnan(gone_of(nan)));
    EXPECT_EQ(gone_of(1e-300), 1e-300);
    EXPECT_EQ(gone_of(std::numeric_limits<double>::denorm_min()), std::numeric_limits<double>::denorm_min());
}

TEST(Exponential, NeverTurnsBack) {
    for (double x = 0.0; x < 5.0; x += 1e-5) {
        ASSERT_LE(left_of(x + 1e-5), left_of(x)) << x;
        ASSERT_GE(gone_of(x + 1e-5), gone_of(x)) << x;
    }
}

}  // namespace
}  // namespace eddy
