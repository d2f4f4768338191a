#include "firmware/accuracy/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace eddy::accuracy {
namespace {

TEST(ObservedOrder, OfAnErrorThatFallsToAQuarterOnHalfTheWidthIsTwo) {
    EXPECT_NEAR(observed_order(0.04, 0.01, 0.2, 0.1).value(), 2.0, 1e-12);
}

TEST(ObservedOrder, OfNoErrorIsUnknown) {
    EXPECT_FALSE(observed_order(0.04, 0.0, 0.2, 0.1));
    EXPECT_FALSE(observed_order(0.04, 0.01, 0.1, 0.1));
}

TEST(Extrapolation, GivesTheFiguresOfNasasWorkedExample) {
    // NASA Glenn, NPARC Alliance, "Examining spatial (grid) convergence": pressure recovery of an inlet on three grids.
    const Extrapolation e = extrapolate({{{1.0, 0.97050}, {2.0, 0.96854}, {4.0, 0.96178}}}).value();
    EXPECT_NEAR(e.order, 1.78617, 1e-5);
    EXPECT_NEAR(e.value, 0.971300, 1e-6);
    EXPECT_NEAR(e.gci, 0.0010308, 1e-7);
}

TEST(Extrapolation, FindsValueAndOrderForAnyWidths) {
    const auto f = [](double h) { return Result{h, 3.0 - 0.7 * std::pow(h, 1.3)}; };
    const Extrapolation e = extrapolate({{f(0.1), f(0.13), f(0.2)}}).value();
    EXPECT_NEAR(e.value, 3.0, 1e-9);
    EXPECT_NEAR(e.order, 1.3, 1e-8);
}

TEST(Extrapolation, OfResultsThatGoToAndFroIsNone) {
    EXPECT_FALSE(extrapolate({{{1.0, 1.0}, {2.0, 1.1}, {4.0, 1.0}}}));
    EXPECT_FALSE(extrapolate({{{1.0, 1.0}, {2.0, 1.0}, {4.0, 1.0}}}));
}

TEST(LinearToZero, ContinuesTheLine) {
    EXPECT_NEAR(linear_to_zero({0.25, 1.5}, {0.5, 2.0}), 1.0, 1e-12);
}

TEST(Worse, IsTheGreaterOfTwoErrorsAndWhatIsNotANumberStaysSo) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(worse(1.0, 2.0), 2.0);
    EXPECT_EQ(worse(2.0, 1.0), 2.0);
    EXPECT_TRUE(std::isnan(worse(kNan, 1.0)));
    EXPECT_TRUE(std::isnan(worse(1.0, kNan)));
}

}  // namespace
}  // namespace eddy::accuracy
