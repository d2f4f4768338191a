#include "tests/redir/cp2112.h"

#include <gtest/gtest.h>
#include <usbredirproto.h>

#include "tests/redir/wire.h"

// As the Linux driver hid-cp2112 and the kernel's HID layer use it.

namespace eddy::redir {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

struct Bridge : testing::Test {
    Cp2112 peer;
    Wire wire{peer};
    RedirGuest& guest = wire.guest;

    ~Bridge() override { EXPECT_TRUE(guest.complaints.empty()) << guest.complaints.front(); }

    RedirGuest::Answer get_feature(std::uint8_t number, std::uint16_t length = 64) {
        const auto value = static_cast<std::uint16_t>(0x0300 | number);
        return wire.wait(guest.control(0xA1, 1, value, 0, length)).value_or(RedirGuest::Answer{0xFF, 0, {}});
    }
    int set_feature(const Bytes& bytes) {
        const auto value = static_cast<std::uint16_t>(0x0300 | bytes[0]);
        const auto length = static_cast<std::uint16_t>(bytes.size());
        const auto answer = wire.wait(guest.control(0x21, 9, value, 0, length, bytes));
        if (!answer) return -1;
        EXPECT_EQ(answer->length, answer->status == usb_redir_success ? bytes.size() : 0);
        return answer->status;
    }
    void say(const std::string& line) { EXPECT_EQ(peer.command(wire.now, line), ""); }
    std::uint8_t levels() {
        const auto answer = get_feature(3, 2);
        return answer.data.size() == 2 ? answer.data[1] : 0;
    }
};

TEST_F(Bridge, IsAHidDevice) {
    ASSERT_TRUE(guest.device);
    EXPECT_EQ(guest.device->vendor, 0x10C4);
    EXPECT_EQ(guest.device->product, 0xEA90);
    EXPECT_EQ(guest.interface_class, 3);
    EXPECT_EQ(guest.endpoints[0x81].type, usb_redir_type_interrupt);
    EXPECT_EQ(guest.endpoints[0x01].type, usb_redir_type_interrupt);
    const auto configuration = wire.wait(guest.control(0x80, 6, 0x0200, 0, 255))->data;
    EXPECT_EQ(configuration.size(), configuration[2]);
}

TEST_F(Bridge, ItsReportDescriptorHasTheLengthItSaysAndEveryReportOnce) {
    const auto hid = wire.wait(guest.control(0x81, 6, 0x2100, 0, 9))->data;
    ASSERT_EQ(hid.size(), 9U);
    const auto report = wire.wait(guest.control(0x81, 6, 0x2200, 0, 4096))->data;
    EXPECT_EQ(report.size(), hid[7] | static_cast<std::size_t>(hid[8]) << 8);
    // Walks the items (HID 1.11, 6.2.2.2): data bytes in the two low bits, tag and type above.
    std::map<std::uint8_t, std::pair<std::uint8_t, int>> reports;
    std::uint8_t number = 0;
    int count = 0, depth = 0;
    std::size_t at = 0;
    while (at < report.size()) {
        const std::uint8_t item = report[at];
        const std::size_t size = (item & 3) == 3 ? 4 : item & 3;
        ASSERT_LE(at + 1 + size, report.size());
        const std::uint8_t value = size > 0 ? report[at + 1] : 0;
        if ((item & 0xFC) == 0x84) number = value;
        if ((item & 0xFC) == 0x94) count = value;
        if ((item & 0xFC) == 0xA0) ++depth;
        if ((item & 0xFC) == 0xC0) --depth;
        for (const std::uint8_t main : {0x80, 0x90, 0xB0})
            if ((item & 0xFC) == main) {
                EXPECT_EQ(reports.count(number), 0U) << int(number);
                reports[number] = {main, count};
            }
        at += 1 + size;
    }
    EXPECT_EQ(at, report.size());
    EXPECT_EQ(depth, 0);
    using Entry = std::pair<std::uint8_t, int>;
    EXPECT_EQ(reports[2], Entry(0xB0, 4));
    EXPECT_EQ(reports[3], Entry(0xB0, 1));
    EXPECT_EQ(reports[4], Entry(0xB0, 2));
    EXPECT_EQ(reports[5], Entry(0xB0, 2));
    EXPECT_EQ(reports[6], Entry(0xB0, 13));
    EXPECT_EQ(reports[0x16], Entry(0x80, 6));
    EXPECT_EQ(reports.size(), 19U);
}

TEST_F(Bridge, FeatureReportsHaveTheLengthsThatTheDriverInsistsOn) {
    EXPECT_EQ(get_feature(2, 5).data.size(), 5U);
    EXPECT_EQ(get_feature(3, 2).data.size(), 2U);
    EXPECT_EQ(get_feature(5, 3).data.size(), 3U);
    EXPECT_EQ(get_feature(6, 14).data.size(), 14U);
    EXPECT_EQ(get_feature(0x20, 2).data.size(), 2U);
    EXPECT_EQ(get_feature(5).data[1], 0x0C) << "part number";
    EXPECT_EQ(get_feature(0x42).status, usb_redir_stall);
    EXPECT_EQ(get_feature(0x15).status, usb_redir_stall) << "that one is an output report";
}

TEST_F(Bridge, KeepsWhatTheDriverWrites) {
    Bytes config = get_feature(6, 14).data;
    config[12] = 0x12;
    config[13] = 1;
    EXPECT_EQ(set_feature(config), usb_redir_success);
    EXPECT_EQ(get_feature(6, 14).data, config);
    const Bytes gpio{2, 0x0F, 0x03, 0, 0};
    EXPECT_EQ(set_feature(gpio), usb_redir_success);
    EXPECT_EQ(get_feature(2, 5).data, gpio);
    EXPECT_EQ(set_feature({2, 0xFF, 0xFF}), usb_redir_stall) << "too short";
    EXPECT_EQ(set_feature({5, 1, 2}), usb_redir_stall) << "nobody writes the version";
    EXPECT_EQ(get_feature(2, 5).data, gpio);
}

TEST_F(Bridge, ALineDrivenByTheGuestShowsOutsideAndNoOther) {
    EXPECT_EQ(set_feature({2, 0x06, 0x02, 0, 0}), usb_redir_success);  // 1 push-pull, 2 open drain
    EXPECT_EQ(set_feature({4, 0x00, 0x02}), usb_redir_success);
    EXPECT_EQ(peer.levels(), 0xFD);
    EXPECT_EQ(peer.outputs(), 0x06);
    EXPECT_EQ(set_feature({4, 0x00, 0xFF}), usb_redir_success);
    EXPECT_EQ(peer.levels(), 0xF9) << "a value is no direction";
    EXPECT_EQ(set_feature({4, 0xFF, 0x04}), usb_redir_success);
    EXPECT_EQ(peer.levels(), 0xFD);
    say("low 2");
    EXPECT_EQ(levels(), 0xF9) << "an open drain that does not pull is what is outside";
    say("low 1");
    EXPECT_EQ(set_feature({4, 0x02, 0x02}), usb_redir_success);
    EXPECT_EQ(levels(), 0xFB) << "push-pull wins";
}

TEST_F(Bridge, AButtonIsSeenWhileItIsPressed) {
    EXPECT_EQ(levels(), 0xFF);
    say("press 0 100ms");
    wire.run(50ms);
    EXPECT_EQ(levels(), 0xFE);
    wire.run(60ms);
    EXPECT_EQ(levels(), 0xFF);
    say("low 7");
    EXPECT_EQ(levels(), 0x7F);
    say("press 7 10ms");
    wire.run(20ms);
    EXPECT_EQ(levels(), 0xFF);
    for (const char* line : {"low", "low 8", "press 0", "press 0 x", "high 1 2", "hold 1"})
        EXPECT_NE(peer.command(wire.now, line), "") << line;
}

TEST_F(Bridge, NobodyAnswersOnItsBus) {
    EXPECT_EQ(wire.wait(guest.start_interrupts(0x81))->status, usb_redir_success);
    EXPECT_EQ(wire.wait(guest.start_interrupts(0x82))->status, usb_redir_inval);
    EXPECT_EQ(wire.wait(guest.interrupt_out(0x01, Bytes{0x10, 0x40, 0, 1}))->status, usb_redir_success);
    wire.run(5ms);
    EXPECT_TRUE(guest.interrupts.empty());
    for (int i = 1; i <= 3; ++i) {
        EXPECT_EQ(wire.wait(guest.interrupt_out(0x01, Bytes{0x15, 1}))->status, usb_redir_success);
        wire.run(5ms);
        ASSERT_EQ(guest.interrupts.size(), static_cast<std::size_t>(i));
        EXPECT_EQ(guest.interrupts.back(), (Bytes{0x16, 3, 0, 0, 0, 0, 0}));
    }
    EXPECT_EQ(wire.wait(guest.stop_interrupts(0x81))->status, usb_redir_success);
    guest.interrupt_out(0x01, Bytes{0x15, 1});
    wire.run(5ms);
    EXPECT_EQ(guest.interrupts.size(), 3U);
}

TEST_F(Bridge, UnpluggedItDrivesNothing) {
    EXPECT_EQ(set_feature({2, 0xFF, 0xFF, 0, 0}), usb_redir_success);
    EXPECT_EQ(set_feature({4, 0x00, 0xFF}), usb_redir_success);
    EXPECT_EQ(peer.levels(), 0x00);
    wire.host.unplug();
    EXPECT_EQ(peer.levels(), 0xFF);
    EXPECT_EQ(peer.outputs(), 0x00);
}

}  // namespace
}  // namespace eddy::redir
