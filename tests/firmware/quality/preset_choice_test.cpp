#include "firmware/quality/preset_choice.h"

#include <gtest/gtest.h>

namespace eddy {
namespace {

using namespace std::chrono_literals;

constexpr std::uint8_t kRight = 1, kTop = 2, kLeft = 8;
const std::vector<SolverPreset> kThree{SolverPreset::Fast, SolverPreset::Precise, SolverPreset::Yang2009};

TEST(PresetChoice, RightButtonGoesOnAndLeftGoesBack) {
    PresetChoice choice(kThree, Seconds(0.0));
    EXPECT_EQ(choice.look(1s, kRight), SolverPreset::Precise);
    choice.look(2s, 0);
    EXPECT_EQ(choice.look(3s, kRight), SolverPreset::Yang2009);
    choice.look(4s, 0);
    EXPECT_EQ(choice.look(5s, kRight), SolverPreset::Fast);
    choice.look(6s, 0);
    EXPECT_EQ(choice.look(7s, kLeft), SolverPreset::Yang2009);
}

TEST(PresetChoice, ButtonHeldDownCountsOnce) {
    PresetChoice choice(kThree, Seconds(0.0));
    EXPECT_TRUE(choice.look(1s, kRight));
    for (int n = 2; n < 100; ++n) EXPECT_FALSE(choice.look(n * 1s, kRight));
}

TEST(PresetChoice, OtherButtonsDoNothing) {
    PresetChoice choice(kThree, Seconds(0.0));
    EXPECT_FALSE(choice.look(1s, kTop));
}

TEST(PresetChoice, ChangesByItselfWhenToldTo) {
    PresetChoice choice(kThree, Seconds(10.0));
    int changes = 0;
    for (int n = 0; n <= 100; ++n) changes += choice.look(n * 1s, 0).has_value() ? 1 : 0;
    EXPECT_EQ(changes, 10);
}

TEST(PresetChoice, PressingAButtonStartsTheWaitAnew) {
    PresetChoice choice(kThree, Seconds(10.0));
    EXPECT_TRUE(choice.look(9s, kRight));
    EXPECT_FALSE(choice.look(12s, 0));
    EXPECT_TRUE(choice.look(19s, 0));
}

TEST(PresetChoice, NothingToChooseFromNeverChanges) {
    for (const std::vector<SolverPreset>& presets :
         {std::vector<SolverPreset>{}, std::vector{SolverPreset::Fast}}) {
        PresetChoice choice(presets, Seconds(1.0));
        for (int n = 0; n < 10; ++n) EXPECT_FALSE(choice.look(n * 5s, n % 2 ? kRight : 0));
    }
}

}  // namespace
}  // namespace eddy
