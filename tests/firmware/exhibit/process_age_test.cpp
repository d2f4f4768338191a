#include "firmware/exhibit/process_age.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace eddy {
namespace {

using namespace std::chrono_literals;

TEST(ProcessAge, GrowsWithTheKernelsClock) {
    const RealClock clock;
    const auto before = process_age();
    ASSERT_TRUE(before);
    EXPECT_GE(before->count(), -0.01) << "in steps of 10 ms";
    std::this_thread::sleep_for(50ms);
    const auto after = process_age();
    ASSERT_TRUE(after);
    EXPECT_GE(after->count() - before->count(), 0.05 - 1e-6);
    EXPECT_LE(after->count() - before->count(), Seconds(clock.now()).count() + 1e-3);
}

TEST(ProcessAge, IsFoundWhateverTheProgramIsCalled) {
    const char* fields = " S 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 4711 20 21\n";
    EXPECT_EQ(start_ticks(std::string("12 (eddy)") + fields), 4711);
    EXPECT_EQ(start_ticks(std::string("12 (ed) dy (1 2)") + fields), 4711);
    EXPECT_FALSE(start_ticks("12 (eddy) S 1 2"));
    EXPECT_FALSE(start_ticks(""));
}

}  // namespace
}  // namespace eddy
