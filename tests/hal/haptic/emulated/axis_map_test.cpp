#include "hal/haptic/emulated/axis_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace eddy::emulated {
namespace {

using ::testing::HasSubstr;

TEST(AxisMap, TurnsZUpIntoYUp) {
    EXPECT_EQ(AxisMap("x,z,-y")({1, 2, 3}), glm::dvec3(1, 3, -2));
    EXPECT_EQ(AxisMap("x,y,z")({1, 2, 3}), glm::dvec3(1, 2, 3));
    EXPECT_EQ(AxisMap("-z,-x,y")({1, 2, 3}), glm::dvec3(-3, -1, 2));
}

void expect_refused(const char* text, const char* why) {
    try {
        const AxisMap map(text);
        FAIL() << text << " was taken";
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr(why)) << text;
        EXPECT_THAT(error.what(), HasSubstr("as in x,z,-y")) << text;
    }
}

TEST(AxisMap, SaysWhatIsWrong) {
    expect_refused("x,z", "three parts");
    expect_refused("", "three parts");
    expect_refused("x,y,z,x", "three parts");
    expect_refused("x,x,z", "uses x twice");
    expect_refused("x,w,z", "'w' for an axis");
    expect_refused("x,,z", "'' for an axis");
    expect_refused("x, y,z", "' y' for an axis");
    expect_refused("x,--y,z", "'-y' for an axis");
}

}  // namespace
}  // namespace eddy::emulated
