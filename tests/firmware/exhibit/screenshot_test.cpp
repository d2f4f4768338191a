#include "firmware/exhibit/screenshot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr std::array<std::uint8_t, 12> kPixels{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

TEST(Screenshot, IsMadeWhenItIsAskedForAndOnce) {
    const ScratchFolder folder;
    Screenshot screenshot(folder.path());
    EXPECT_FALSE(screenshot.wanted(0s));
    folder.write("screenshot.request", "");
    EXPECT_TRUE(screenshot.wanted(300ms));
    EXPECT_THAT(screenshot.give(2, 2, kPixels), HasSubstr(folder / "screenshot.png"));
    EXPECT_THAT(folder.listing(), ElementsAre("screenshot.png"));
    EXPECT_EQ(read_all(folder / "screenshot.png").substr(1, 3), "PNG");
    EXPECT_FALSE(screenshot.wanted(600ms));
}

TEST(Screenshot, LooksFourTimesASecondAtMost) {
    const ScratchFolder folder;
    Screenshot screenshot(folder.path());
    screenshot.wanted(0s);
    folder.write("screenshot.request", "");
    EXPECT_FALSE(screenshot.wanted(249ms));
    EXPECT_TRUE(screenshot.wanted(250ms));
}

TEST(Screenshot, OneThatCannotBeWrittenIsNotTriedForEver) {
    const ScratchFolder folder;
    Screenshot screenshot(folder.path());
    std::filesystem::create_directories(folder / "screenshot.png.new");  // in the way
    folder.write("screenshot.request", "");
    EXPECT_TRUE(screenshot.wanted(0s));
    EXPECT_THAT(screenshot.give(2, 2, kPixels), HasSubstr("no picture of the screen: "));
    EXPECT_FALSE(screenshot.wanted(1s));
}

TEST(Screenshot, WithoutARunFolderNobodyCanAsk) {
    EXPECT_FALSE(Screenshot("").wanted(0s));
}

}  // namespace
}  // namespace eddy
