#include "hal/haptic/falcon/firmware_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hal/haptic/synthetic_firmware.h"

namespace eddy::falcon {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;

TEST(FirmwareImage, IsAcceptedWhenItsBlocksEndWithTheFile) {
    EXPECT_EQ(problem_in_firmware(synthetic_firmware(1)), std::nullopt);
    EXPECT_EQ(problem_in_firmware(synthetic_firmware(4000)), std::nullopt);
}

TEST(FirmwareImage, MayHaveSeveralBlocks) {
    auto image = synthetic_firmware(10);
    image.resize(image.size() - 2);
    const std::vector<std::uint8_t> second{1, 0, 0x3F, 0, 0, 0x90, 0xEF, 0xBE, 0, 0};
    image.insert(image.end(), second.begin(), second.end());
    EXPECT_EQ(problem_in_firmware(image), std::nullopt);
}

TEST(FirmwareImage, IsRefusedWithoutItsKey) {
    auto image = synthetic_firmware(10);
    image[1] = 0x09;
    EXPECT_THAT(problem_in_firmware(image), Optional(HasSubstr("AA 08")));
}

TEST(FirmwareImage, IsRefusedWhereverItIsCut) {
    const auto image = synthetic_firmware(10);
    for (std::size_t size = 0; size < image.size(); ++size)
        EXPECT_THAT(problem_in_firmware(std::span(image).first(size)), Optional(HasSubstr("cut short")))
            << size;
}

TEST(FirmwareImage, IsRefusedWithBytesAfterItsEnd) {
    auto image = synthetic_firmware(10);
    image.push_back(0);
    EXPECT_THAT(problem_in_firmware(image), Optional(HasSubstr("goes on")));
}

}  // namespace
}  // namespace eddy::falcon
