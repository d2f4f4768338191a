#include "firmware/accuracy/sweep/pareto.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace eddy::accuracy::sweep {
namespace {

Measurement found(double wall_ms, double error) {
    Measurement m;
    m.wall_ms.p50 = wall_ms;
    m.error = error;
    return m;
}

Chosen all_of(const std::vector<Measurement>& measured) {
    return chosen(measured, [](const Measurement&) { return true; });
}

TEST(Pareto, FrontHoldsWhatNothingBeatsInBothWays) {
    const std::vector<Measurement> measured{found(8.0, 0.02),  // on it
                                            found(3.0, 0.30),  // slower and worse than the next
                                            found(2.0, 0.10),  // on it
                                            found(9.0, 0.02),  // slower and no better
                                            found(1.0, 0.50),  // on it
                                            found(1.0, std::nan(""))};
    EXPECT_THAT(front(all_of(measured)), testing::ElementsAre(&measured[4], &measured[2], &measured[0]));
}

TEST(Pareto, QuickestWithinAnErrorMayBeMoreExactThanAsked) {
    const std::vector<Measurement> measured{found(1.0, 0.5), found(2.0, 0.01), found(3.0, 0.04)};
    EXPECT_EQ(quickest_within(all_of(measured), 0.05), &measured[1]);
    EXPECT_EQ(quickest_within(all_of(measured), 0.5), &measured[0]);
    EXPECT_EQ(quickest_within(all_of(measured), 0.005), nullptr);
}

TEST(Pareto, BestWithinATimeMayBeQuickerThanAsked) {
    const std::vector<Measurement> measured{found(10.0, 0.1), found(12.0, 0.2), found(40.0, 0.01)};
    EXPECT_EQ(best_within(all_of(measured), 20.0), &measured[0]);
    EXPECT_EQ(best_within(all_of(measured), 40.0), &measured[2]);
    EXPECT_EQ(best_within(all_of(measured), 5.0), nullptr);
}

TEST(Pareto, EnoughIsWhereTheRestGainsLessThanATenth) {
    const std::vector<Measurement> flattens{found(1, 0.50), found(2, 0.20), found(3, 0.19), found(4, 0.185)};
    EXPECT_EQ(enough(all_of(flattens)), &flattens[1]);
    // The last step of a curve that still falls is never waste.
    const std::vector<Measurement> falls{found(1, 0.8), found(2, 0.4), found(3, 0.2)};
    EXPECT_EQ(enough(all_of(falls)), &falls[2]);
    // Little each time, but much together.
    const std::vector<Measurement> creeps{found(1, 1.0), found(2, 0.92), found(3, 0.85)};
    EXPECT_EQ(enough(all_of(creeps)), &creeps[1]);
    EXPECT_EQ(enough(all_of({found(1, 0.1)})), nullptr);
}

}  // namespace
}  // namespace eddy::accuracy::sweep
