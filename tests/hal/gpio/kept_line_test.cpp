#include "hal/gpio/kept_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/gpio/emulated_gpio.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

struct Bridge {
    EmulatedGpio gpio;
    Bridge() { gpio.add("bridge", {"in", "out"}); }
};

TEST(KeptLine, WithoutAnAddressIsNothingAndNoTrouble) {
    Bridge bridge;
    KeptLine line(bridge.gpio, "", {});
    EXPECT_FALSE(line.wanted());
    EXPECT_EQ(line.read(0s), std::nullopt);
    line.write(0s, true);
    EXPECT_EQ(line.trouble(), "");
}

TEST(KeptLine, ComesBackWithinASecondOfItsBridge) {
    Bridge bridge;
    KeptLine line(bridge.gpio, "in", {});
    EXPECT_EQ(line.read(0s), true);
    EXPECT_GE(line.edges_fd(), 0);
    bridge.gpio.unplug("bridge");
    EXPECT_EQ(line.read(1s), std::nullopt);
    EXPECT_EQ(line.edges_fd(), -1);
    EXPECT_THAT(line.trouble(), HasSubstr("GPIO line 'in' went away (emulated: No such device)"));
    bridge.gpio.plug_in("bridge");
    EXPECT_EQ(line.read(1999ms), std::nullopt) << "it was looked for less than a second ago";
    EXPECT_EQ(line.read(2s), true);
    EXPECT_EQ(line.trouble(), "");
}

TEST(KeptLine, AnOutputIsSaidAgainAfterItWasAway) {
    Bridge bridge;
    KeptLine line(bridge.gpio, "out", {.output = true});
    line.write(0s, true);
    EXPECT_TRUE(bridge.gpio.is_high("out"));
    bridge.gpio.unplug("bridge");
    line.write(500ms, true);
    EXPECT_EQ(line.trouble(), "") << "nothing was said, so nothing is known";
    line.write(1s, true);
    EXPECT_THAT(line.trouble(), HasSubstr("went away"));
    bridge.gpio.plug_in("bridge");
    bridge.gpio.set_high("out", false);
    line.write(2s, true);
    EXPECT_TRUE(bridge.gpio.is_high("out"));
}

}  // namespace
}  // namespace eddy
