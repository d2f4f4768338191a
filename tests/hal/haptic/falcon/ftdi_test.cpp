#include "hal/haptic/falcon/ftdi.h"

#include <gtest/gtest.h>

#include <vector>

namespace eddy::falcon {
namespace {

// Words as Linux ftdi_sio.h defines them.
TEST(Ftdi, WritesTheRequestsOfTheChip) {
    EXPECT_EQ(purge_receiver(), (ControlRequest{0x40, 0, 1, 0}));
    EXPECT_EQ(purge_transmitter(), (ControlRequest{0x40, 0, 2, 0}));
    EXPECT_EQ(set_dtr(true), (ControlRequest{0x40, 1, 0x0101, 0}));
    EXPECT_EQ(set_dtr(false), (ControlRequest{0x40, 1, 0x0100, 0}));
    EXPECT_EQ(set_rts(false), (ControlRequest{0x40, 1, 0x0200, 0}));
    EXPECT_EQ(no_flow_control(), (ControlRequest{0x40, 2, 0, 0}));
    EXPECT_EQ(eight_bits_no_parity_one_stop(), (ControlRequest{0x40, 4, 8, 0}));
    EXPECT_EQ(flush_on('>'), (ControlRequest{0x40, 6, 0x013E, 0}));
    EXPECT_EQ(set_latency(16), (ControlRequest{0x40, 9, 16, 0}));
}

TEST(Ftdi, SetsTheFalconsThreeRates) {
    EXPECT_DOUBLE_EQ(baud_rate(baud_9600()), 9600.0);
    EXPECT_NEAR(baud_rate(baud_142857()), 142857.0, 0.5);
    EXPECT_DOUBLE_EQ(baud_rate(baud_1500000()), 1.5e6);
    EXPECT_DOUBLE_EQ(baud_rate({0x40, 3, 0, 0}), 3e6);
    EXPECT_DOUBLE_EQ(baud_rate({0x40, 3, 1, 0}), 2e6);
    EXPECT_DOUBLE_EQ(baud_rate({0x40, 3, 0xC004, 1}), 3e6 / 4.875)
        << "bit 2 of the fraction travels in wIndex";
}

TEST(Ftdi, StripsTwoStatusBytesFromEachPacket) {
    Packet packet;
    packet.bytes = {0x01, 0x60, 'A', 'B'};
    packet.size = 4;
    const Payload payload = strip_status(packet);
    EXPECT_EQ(std::vector(payload.bytes.begin(), payload.bytes.end()), (std::vector<std::uint8_t>{'A', 'B'}));
    EXPECT_FALSE(payload.line_fault);
    packet.size = 2;
    EXPECT_TRUE(strip_status(packet).bytes.empty());
    packet.size = 1;
    EXPECT_TRUE(strip_status(packet).bytes.empty());
    packet.size = kPacketBytes;
    EXPECT_EQ(strip_status(packet).bytes.size(), 62U);
}

TEST(Ftdi, NoticesLineFaults) {
    Packet packet;
    packet.size = 2;
    for (const std::uint8_t fault : {0x02, 0x04, 0x08, 0x80}) {
        packet.bytes[1] = static_cast<std::uint8_t>(0x60 | fault);
        EXPECT_TRUE(strip_status(packet).line_fault);
    }
    for (const std::uint8_t harmless : {0x01, 0x10, 0x20, 0x40}) {
        packet.bytes[1] = harmless;
        EXPECT_FALSE(strip_status(packet).line_fault);
    }
}

}  // namespace
}  // namespace eddy::falcon
