#include "firmware/force_comparison.h"

#include <gtest/gtest.h>

namespace eddy {
namespace {

TEST(ForceComparison, SpreadIsTheLargestDifferenceOverTheForceInTheMeanOfSquares) {
    ForceComparison comparison(1);
    // 3 and 4 N on the first body, 1 N apart and then the same.
    comparison.add({{.force_n = {3.0, 0.0, 0.0}}}, {{{3.5, 0.0, 0.0}, {2.5, 0.0, 0.0}, {0.0, 0.0, 2.0}}});
    comparison.add({{.force_n = {0.0, 4.0, 0.0}}}, {{{0.0, 4.0, 0.0}, {0.0, 4.0, 0.0}, {}}});
    EXPECT_DOUBLE_EQ(comparison.spread(0).value(), 1.0 / 5.0);
    EXPECT_DOUBLE_EQ(comparison.transport(0).value(), 2.0 / 5.0);
}

TEST(ForceComparison, SaysNothingOfABodyWhoseForceIsNotMeasured) {
    ForceComparison comparison(1);
    comparison.add({{}}, {{{3.5, 0.0, 0.0}, {2.5, 0.0, 0.0}, {0.0, 0.0, 2.0}}});
    EXPECT_FALSE(comparison.spread(0));
    EXPECT_FALSE(comparison.transport(0));
}

TEST(ForceComparison, HasAValueForEachColumn) {
    const std::vector<std::string> columns = ForceComparison::columns();
    const std::vector<double> values =
        ForceComparison::values({{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, {7.0, 8.0, 9.0}});
    ASSERT_EQ(columns.size(), values.size());
    EXPECT_EQ(columns[1], "force_box_y_n");
    EXPECT_EQ(values[1], 2.0);
    EXPECT_EQ(columns[5], "force_impulse_z_n");
    EXPECT_EQ(values[5], 6.0);
    EXPECT_EQ(columns[6], "transport_x_n");
    EXPECT_EQ(values[6], 7.0);
}

}  // namespace
}  // namespace eddy
