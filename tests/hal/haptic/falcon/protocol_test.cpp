#include "hal/haptic/falcon/protocol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace eddy::falcon {
namespace {

std::string text(const Frame& frame) {
    return {frame.begin(), frame.end()};
}

Frame frame_of(const std::string& text) {
    Frame frame{};
    std::copy(text.begin(), text.end(), frame.begin());
    return frame;
}

std::vector<Reply> find_all(const std::vector<std::uint8_t>& bytes) {
    FrameFinder finder;
    std::vector<Reply> found;
    for (const std::uint8_t byte : bytes)
        if (const auto frame = finder.push(byte)) found.push_back(decode_reply(*frame));
    return found;
}

void append(std::vector<std::uint8_t>& bytes, const Frame& frame, std::size_t first = 0,
            std::size_t last = kFrameBytes) {
    bytes.insert(bytes.end(), frame.begin() + static_cast<std::ptrdiff_t>(first),
                 frame.begin() + static_cast<std::ptrdiff_t>(last));
}

// Frames as libnifalcon's firmware class makes and reads them.
TEST(FalconProtocol, EncodesCommandsAsTheFirmwareReadsThem) {
    EXPECT_EQ(text(encode(Command{})), "<AAAAAAAAAAAAAA>");
    EXPECT_EQ(text(encode(Command{.homing = true, .red = true})), "<AAAAAAAAAAAAJA>");
    EXPECT_EQ(text(encode(Command{.green = true})), "<AAAAAAAAAAAACA>");
    EXPECT_EQ(text(encode(Command{.blue = true})), "<AAAAAAAAAAAAEA>");
    EXPECT_EQ(text(encode(Command{.red = true})), "<AAAAAAAAAAAAIA>");
    EXPECT_EQ(text(encode(Command{.red = true, .green = true, .blue = true})), "<AAAAAAAAAAAAOA>");
    EXPECT_EQ(text(encode(Command{.motors = {-213, 709, -496}, .green = true})), "<LCPPFMCAABOPCA>");
    EXPECT_EQ(text(encode(Command{.motors = {4095, -4095, 1}, .blue = true})), "<PPPABAAPBAAAEA>");
}

TEST(FalconProtocol, DecodesRepliesAsTheFirmwareSendsThem) {
    EXPECT_EQ(decode_reply(frame_of("<AFBAAFBAAFBA\xB2"
                                    "A>")),
              (Reply{.encoders = {336, 336, 336}, .homed = {true, true, true}, .buttons = 1}));
    EXPECT_EQ(decode_reply(frame_of("<BMOPCLNPFIBA\xB1"
                                    "A>")),
              (Reply{.encoders = {-319, -590, 389}, .homed = {true, true, true}}));
    EXPECT_EQ(decode_reply(frame_of("<MPKPMPKPMPKPAA>")), (Reply{.encoders = {-1284, -1284, -1284}}));
    EXPECT_EQ(decode_reply(frame_of("<JFKPAAAAAAAAAA>")).encoders[0], -1447);
}

TEST(FalconProtocol, TellsTheThreeHomedBitsApart) {
    EXPECT_EQ(decode_reply(frame_of("<AAAAAAAAAAAAQA>")).homed, (std::array{true, false, false}));
    EXPECT_EQ(decode_reply(frame_of("<AAAAAAAAAAAAaA>")).homed, (std::array{false, true, false}));
    EXPECT_EQ(decode_reply(frame_of("<AAAAAAAAAAAA\x81"
                                    "A>"))
                  .homed,
              (std::array{false, false, true}));
}

TEST(FalconProtocol, ReadsBackEveryValueItWrites) {
    for (int value = -32768; value <= 32767; ++value) {
        const Reply reply{.encoders = {value, ~value, value / 2},
                          .buttons = static_cast<std::uint8_t>(value & 0xF)};
        ASSERT_EQ(decode_reply(encode(reply)), reply);
    }
    const Command command{.motors = {-4095, 17, 4095}, .homing = true, .blue = true};
    EXPECT_EQ(decode_command(encode(command)), command);
}

TEST(FalconProtocol, ClampsMotorsToTheirRange) {
    const Command wild{.motors = {300000, -4096, std::numeric_limits<int>::min()}};
    EXPECT_EQ(decode_command(encode(wild)).motors, (Axes{4095, -4095, -4095}));
}

TEST(FrameFinder, FindsAFrameAfterAnyNonsense) {
    std::mt19937_64 random(7);
    const Reply reply{.encoders = {-1447, 5, 12000}, .homed = {true, false, true}, .buttons = 9};
    int found = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::vector<std::uint8_t> bytes(random() % 40);
        for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
        // Letters of the protocol are the nonsense that is hardest to tell.
        if (trial % 2 == 0)
            for (auto& byte : bytes) byte = static_cast<std::uint8_t>(0x3C + random() % 8);
        append(bytes, encode(reply));
        append(bytes, encode(reply));
        const auto replies = find_all(bytes);
        // The nonsense may end in what looks like the beginning of a frame and cost the first; never the
        // second.
        ASSERT_FALSE(replies.empty()) << "trial " << trial;
        ASSERT_EQ(replies.back(), reply) << "trial " << trial;
        found += static_cast<int>(replies.size());
    }
    EXPECT_GT(found, 39900) << "nearly always both are found";
}

TEST(FrameFinder, DoesNotCareHowReplesAreSplitIntoPackets) {
    const Frame frame = encode(Reply{.encoders = {1, -2, 3}});
    for (std::size_t split = 0; split <= kFrameBytes; ++split) {
        FrameFinder finder;
        int found = 0;
        for (std::size_t i = 0; i < split; ++i) found += finder.push(frame[i]).has_value();
        for (std::size_t i = split; i < kFrameBytes; ++i) found += finder.push(frame[i]).has_value();
        EXPECT_EQ(found, 1);
        EXPECT_EQ(finder.dropped(), 0U);
    }
}

TEST(FrameFinder, LosesOnlyTheFrameFromWhichAByteIsMissing) {
    const Reply reply{.encoders = {-319, -590, 389}, .homed = {true, true, true}};
    for (std::size_t lost = 0; lost < kFrameBytes; ++lost) {
        std::vector<std::uint8_t> bytes;
        append(bytes, encode(reply), 0, lost);
        append(bytes, encode(reply), lost + 1);
        append(bytes, encode(reply));
        append(bytes, encode(reply));
        const auto replies = find_all(bytes);
        ASSERT_EQ(replies.size(), 2U) << "byte " << lost;
        for (const Reply& found : replies) EXPECT_EQ(found, reply);
    }
}

// libnifalcon pull request 30: such replies were read as homed = 7, buttons = 13.
TEST(FrameFinder, RefusesAReplyOfFourteenBytes) {
    const Reply reply{.encoders = {-319, -590, 389}, .homed = {true, true, true}};
    std::vector<std::uint8_t> bytes;
    append(bytes, encode(reply), 0, 14);
    append(bytes, encode(reply));
    EXPECT_EQ(find_all(bytes), std::vector{reply});
}

TEST(FrameFinder, CountsTheBytesItDrops) {
    FrameFinder finder;
    for (const std::uint8_t byte : {0x00, 0x3C, 0x41, 0xFF}) finder.push(byte);
    EXPECT_EQ(finder.dropped(), 4U);
    finder.push('<');
    finder.push('A');
    finder.clear();
    EXPECT_EQ(finder.dropped(), 6U);
}

}  // namespace
}  // namespace eddy::falcon
