#include "hal/display/kms/edid.h"

#include <gtest/gtest.h>

#include "hal/display/emulated/emulated_card.h"

namespace eddy::kms {
namespace {

using emulated::make_edid;

TEST(Edid, TellsTheNameOfTheMonitor) {
    EXPECT_EQ(monitor_name(make_edid("Hall 1")), "Hall 1");
    EXPECT_EQ(monitor_name(make_edid("Thirteen char")), "Thirteen char");
}

TEST(Edid, WithoutANameTheMakerAndTheProductMustDo) {
    std::vector<std::uint8_t> edid = make_edid("Hall 1");
    edid[54 + 3] = 0;
    edid[8] = 0x10;  // DEL: 00100 00101 01100
    edid[9] = 0xac;
    edid[10] = 0x34;
    edid[11] = 0x12;
    EXPECT_EQ(monitor_name(edid), "DEL 1234");
}

TEST(Edid, NoiseHasNoNameAndDoesNoHarm) {
    EXPECT_EQ(monitor_name({}), "");
    const std::vector<std::uint8_t> noise(127, 0xfc);
    EXPECT_EQ(monitor_name(noise), "");
    EXPECT_NE(monitor_id(noise), "");
}

TEST(Edid, TheIdTellsOneMonitorFromAnother) {
    EXPECT_EQ(monitor_id(make_edid("Hall 1")), monitor_id(make_edid("Hall 1")));
    EXPECT_NE(monitor_id(make_edid("Hall 1")), monitor_id(make_edid("Hall 2")));
    EXPECT_EQ(monitor_id({}), "");
    EXPECT_EQ(monitor_id(make_edid("Hall 1")).size(), 16U);
}

}  // namespace
}  // namespace eddy::kms
