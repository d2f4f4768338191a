#include "firmware/exhibit/lamp_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

TEST(LampTable, OfTheWiringPageSaysWhatTheLampsDo) {
    EXPECT_THAT(read_all(EDDY_SOURCE_DIR "/docs/wiring.md"), testing::HasSubstr("\n" + lamp_table()))
        << "eddy panel --codes prints it";
}

}  // namespace
}  // namespace eddy
