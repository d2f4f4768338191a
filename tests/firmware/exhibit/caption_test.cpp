#include "firmware/exhibit/caption.h"

#include <gmock/gmock.h>

namespace eddy {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(Caption, SaysNothingWhileAllIsWell) {
    EXPECT_THAT(caption({.has_device = true, .device = HapticState::Ready}), IsEmpty());
    EXPECT_THAT(caption({.has_device = true, .device = HapticState::Ready, .force = GateReason::Starting}),
                IsEmpty());
    EXPECT_THAT(caption({}), IsEmpty()) << "an exhibit without a hand is to be watched";
}

TEST(Caption, ShowsTheWayThroughHoming) {
    EXPECT_THAT(caption({.has_device = true,
                         .device = HapticState::Homing,
                         .force = GateReason::DeviceNotReady,
                         .about_to_idle = true}),
                HasSubstr("all the way out, then push it all the way in"));
}

TEST(Caption, MissesOnlyAHandleThatWasThere) {
    CaptionInput in{.has_device = true, .device = HapticState::Absent, .force = GateReason::DeviceNotReady};
    EXPECT_THAT(caption(in), IsEmpty());
    in.seen_before = true;
    EXPECT_THAT(caption(in), HasSubstr("not connected"));
}

TEST(Caption, PutsTheStopButtonAboveEverything) {
    for (const HapticState state : {HapticState::Absent, HapticState::Homing, HapticState::Ready})
        EXPECT_THAT(caption({.has_device = true, .device = state, .force = GateReason::Stopped}),
                    HasSubstr("stop button"));
}

TEST(Caption, AsksBeforeTheSceneStartsAgain) {
    EXPECT_THAT(caption({.has_device = true, .device = HapticState::Ready, .about_to_idle = true}),
                HasSubstr("Still there?"));
}

TEST(CaptionPage, StandsInsideThePictureWhateverItsSize) {
    const std::string sentence = caption({.force = GateReason::Stopped});
    for (const glm::ivec2 picture : {glm::ivec2(160, 120), glm::ivec2(1920, 1080), glm::ivec2(1080, 1920)}) {
        const gles::Page page = caption_page(sentence, picture);
        EXPECT_GE(page.corner_px.x, 0);
        EXPECT_LE(page.corner_px.x + page.size_px.x, picture.x);
        EXPECT_LE(page.corner_px.y + page.size_px.y, picture.y);
        EXPECT_GT(page.corner_px.y, picture.y / 2) << "below the fluid";
        const gles::Font font;
        for (const gles::TextLine& line : page.lines) {
            EXPECT_LE(font.width_px(line.text, line.size_px), page.size_px.x);
            EXPECT_LE(line.at_px.y, page.size_px.y);
        }
    }
    EXPECT_TRUE(caption_page("", {640, 480}).empty());
}

}  // namespace
}  // namespace eddy
