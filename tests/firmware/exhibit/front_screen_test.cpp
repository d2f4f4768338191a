#include <gtest/gtest.h>

#include "firmware/exhibit/front.h"
#include "hal/display/emulated/emulated_machine.h"
#include "hal/display/kms/kms_display.h"

// Words on an emulated screen, while nothing plays.

namespace eddy {
namespace {

using namespace std::chrono_literals;

TEST(FrontOnAScreen, ShowsWordsAgainAndAgainInThePausesOfLongWork) {
    emulated::ScreenMachine machine;
    machine.card().plugs[0].modes = {emulated::make_mode(160, 90, 60.0, true)};
    HandSide nobody(nullptr, "none", {}, {});
    Front front(std::make_unique<Graphics>(std::make_unique<kms::KmsDisplay>(machine.machine(), kms::Wish{})),
                nobody, {}, 0);
    const auto flips = [&] { return front.graphics().display->counters().flips; };
    EXPECT_FALSE(front.has_shown_words());
    Instant now = machine.now();
    for (const Instant end = now + 60s; now < end && flips() < 4; now = machine.now()) {
        machine.wait(1ms);
        EXPECT_TRUE(front.wait({"Eddy is starting", "Getting the fluid ready."}, machine.now()));
    }
    EXPECT_EQ(flips(), 4);
    EXPECT_TRUE(front.has_shown_words());
    EXPECT_GE(now, 150ms) << "pauses come far more often than pictures";
}

}  // namespace
}  // namespace eddy
