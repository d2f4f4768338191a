#include "tests/redir/redir_host.h"

#include <usbredirproto.h>

#include <algorithm>
#include <random>

#include "tests/hal/haptic/falcon/rig.h"
#include "tests/redir/cp2112.h"
#include "tests/redir/falcon_peer.h"
#include "tests/redir/wire.h"

namespace eddy::redir {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

struct RedirHostTest : testing::Test {
    FalconPeer peer{still(), {}};
    Wire wire{peer};
    RedirGuest& guest = wire.guest;

    ~RedirHostTest() override { EXPECT_TRUE(guest.complaints.empty()) << guest.complaints.front(); }

    RedirGuest::Answer get(std::uint16_t value, std::uint16_t length) {
        const auto answer = wire.wait(guest.control(0x80, 6, value, 0, length));
        return answer.value_or(RedirGuest::Answer{0xFF, 0, {}});
    }
};

TEST_F(RedirHostTest, ShowsTheDeviceOnceTheGuestHasSaidHello) {
    FalconPeer other(still(), {});
    RedirHost host(other, true);
    RedirGuest late;
    late.receive(host.take_output());
    EXPECT_FALSE(late.device);

    ASSERT_TRUE(guest.device);
    EXPECT_EQ(guest.device->vendor, 0x0403);
    EXPECT_EQ(guest.device->product, 0xCB48);
    EXPECT_EQ(guest.device->version, 0x0600);
    EXPECT_EQ(guest.device->speed, usb_redir_speed_full);
    EXPECT_EQ(guest.interfaces, 1U);
    EXPECT_EQ(guest.interface_class, 0xFF);
    ASSERT_EQ(guest.endpoints.size(), 4U);
    EXPECT_EQ(guest.endpoints[0x81].type, usb_redir_type_bulk);
    EXPECT_EQ(guest.endpoints[0x02].type, usb_redir_type_bulk);
    EXPECT_EQ(guest.endpoints[0x02].packet, 64);
}

TEST_F(RedirHostTest, AnswersWithTheDevicesOwnDescriptorsCutToWhatWasAskedFor) {
    const auto all = peer.descriptors();
    const auto device = get(0x0100, 18);
    EXPECT_EQ(device.status, usb_redir_success);
    EXPECT_EQ(device.length, 18U);
    EXPECT_EQ(device.data, Bytes(all.begin(), all.begin() + 18));
    EXPECT_EQ(get(0x0100, 8).data, Bytes(all.begin(), all.begin() + 8));
    EXPECT_EQ(get(0x0200, 255).data, Bytes(all.begin() + 18, all.end()));
    EXPECT_EQ(get(0x0777, 255).status, usb_redir_stall);
}

TEST_F(RedirHostTest, AReadIsAnsweredWhenTheChipHasSomethingToSayAndNotBefore) {
    ASSERT_EQ(wire.wait(guest.control(0x40, 9, 40, 0, 0))->status, usb_redir_success);  // latency 40 ms
    wire.run(45ms);
    ASSERT_TRUE(wire.wait(guest.bulk_in(0x81, 64), 50ms));
    const auto read = guest.bulk_in(0x81, 64);
    EXPECT_FALSE(wire.wait(read, 35ms));
    const auto answer = wire.wait(read, 10ms);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->data, (Bytes{0x01, 0x60}));
    EXPECT_EQ(answer->length, 2U);
}

TEST_F(RedirHostTest, EndsARequestThatTheGuestCancelsAndOnlyThat) {
    const auto first = guest.bulk_in(0x81, 64), second = guest.bulk_in(0x81, 64);
    wire.carry();
    guest.cancel(first);
    guest.cancel(4711);
    const auto answer = wire.wait(first, 1ms);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, usb_redir_cancelled);
    const auto other = wire.wait(second, 30ms);
    ASSERT_TRUE(other);
    EXPECT_EQ(other->status, usb_redir_success);
    guest.cancel(second);  // too late
    wire.run(30ms);
    EXPECT_FALSE(guest.take(second));
}

TEST_F(RedirHostTest, AResetEndsWhatIsUnderWayAndTheChipBeginsAnew) {
    ASSERT_EQ(wire.wait(guest.control(0x40, 9, 77, 0, 0))->status, usb_redir_success);
    EXPECT_EQ(wire.wait(guest.control(0xC0, 10, 0, 0, 1))->data, Bytes{77});
    wire.run(80ms);
    ASSERT_TRUE(wire.wait(guest.bulk_in(0x81, 64), 80ms));
    const auto read = guest.bulk_in(0x81, 64);
    wire.carry();
    guest.reset();
    EXPECT_EQ(wire.wait(read, 1ms)->status, usb_redir_cancelled);
    EXPECT_EQ(wire.wait(guest.control(0xC0, 10, 0, 0, 1))->data, Bytes{16});
    EXPECT_EQ(peer.board().state(), emulated::BoardState::RunHomed) << "its own supply is not the bus's";
}

TEST_F(RedirHostTest, HasOneConfigurationAndOneSetting) {
    EXPECT_EQ(wire.wait(guest.set_configuration(1))->status, usb_redir_success);
    EXPECT_EQ(wire.wait(guest.get_configuration())->data, Bytes{1});
    EXPECT_EQ(wire.wait(guest.set_configuration(2))->status, usb_redir_inval);
    EXPECT_EQ(wire.wait(guest.get_configuration())->data, Bytes{1});
    EXPECT_EQ(wire.wait(guest.set_configuration(0))->status, usb_redir_success);
    EXPECT_EQ(wire.wait(guest.get_configuration())->data, Bytes{0});
    EXPECT_EQ(wire.wait(guest.set_alt_setting(0))->status, usb_redir_success);
    EXPECT_EQ(wire.wait(guest.set_alt_setting(1))->status, usb_redir_inval);
}

TEST_F(RedirHostTest, APulledPlugIsADisconnection) {
    const auto read = guest.bulk_in(0x81, 64);
    wire.carry();
    wire.host.unplug();
    wire.run(1ms);
    EXPECT_FALSE(guest.device);
    EXPECT_EQ(guest.disconnections, 1);
    EXPECT_FALSE(wire.host.attached());
    wire.run(50ms);
    EXPECT_FALSE(guest.take(read));
    wire.host.plug_in();
    wire.run(1ms);
    ASSERT_TRUE(guest.device);
    EXPECT_EQ(get(0x0100, 18).status, usb_redir_success);
}

TEST_F(RedirHostTest, ShowsADeviceAgainOnlyWhenTheGuestKnowsThatItHadGone) {
    wire.host.unplug();
    wire.host.plug_in();
    guest.receive(wire.host.take_output());
    EXPECT_EQ(guest.disconnections, 1);
    EXPECT_FALSE(guest.device);
    guest.control(0x80, 6, 0x0100, 0, 18);  // said before it knew: goes nowhere
    wire.carry();
    EXPECT_TRUE(guest.device);
    EXPECT_TRUE(wire.host.attached());
}

TEST_F(RedirHostTest, RefusesMoreThanADeviceCouldWant) {
    EXPECT_EQ(wire.wait(guest.bulk_in(0x81, 1U << 26))->status, usb_redir_inval);
    ASSERT_EQ(wire.wait(guest.control(0x40, 9, 255, 0, 0))->status, usb_redir_success);
    std::vector<std::uint64_t> reads;
    for (int i = 0; i < 300; ++i) reads.push_back(guest.bulk_in(0x81, 64));
    wire.carry();
    wire.host.poll(wire.now);
    wire.carry();
    const auto refused = std::count_if(reads.begin(), reads.end(), [&](std::uint64_t id) {
        const auto answer = guest.take(id);
        return answer && answer->status == usb_redir_inval;
    });
    EXPECT_EQ(refused, 300 - 256);
}

TEST_F(RedirHostTest, ABadCableAndAStallAreSaid) {
    peer.device().falcon().stalled = true;
    EXPECT_EQ(wire.wait(guest.bulk_in(0x81, 64))->status, usb_redir_stall);
    EXPECT_EQ(wire.wait(guest.bulk_out(0x02, Bytes{1, 2, 3}))->status, usb_redir_stall);
    peer.device().falcon().stalled = false;
    peer.device().garbled = true;
    EXPECT_EQ(wire.wait(guest.bulk_in(0x81, 64))->status, usb_redir_ioerror);
}

/// What a guest says that starts, asks for much and goes.
Bytes conversation(UsbPeer& peer) {
    RedirGuest guest;
    Bytes said = guest.take_output();
    RedirHost host(peer, true);
    host.receive(said);
    guest.receive(host.take_output());
    guest.reset();
    guest.set_configuration(1);
    guest.control(0x80, 6, 0x0100, 0, 18);
    guest.control(0xA1, 1, 0x0303, 0, 2);
    guest.control(0x21, 9, 0x0304, 0, 3, Bytes{4, 0, 2});
    guest.control(0x40, 3, 2, 0, 0);
    guest.start_interrupts(0x81);
    guest.interrupt_out(0x01, Bytes{0x15, 1});
    guest.bulk_out(0x02, Bytes(16, 0x41));
    guest.cancel(guest.bulk_in(0x81, 512));
    guest.set_alt_setting(0);
    guest.stop_interrupts(0x81);
    const Bytes more = guest.take_output();
    said.insert(said.end(), more.begin(), more.end());
    return said;
}

/// Feeds disturbed and cut conversations, in pieces, and sees each time that the device serves the next guest well.
template <typename Peer>
void survives_anything(Peer& peer, const int rounds, std::uint64_t seed) {
    const Bytes whole = conversation(peer);
    std::mt19937_64 random(seed);
    int refused = 0;
    Instant now{0};
    for (int round = 0; round < rounds; ++round) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", round " << round);
        Bytes said = whole;
        for (auto times = random() % 8; times > 0; --times) {
            const auto at = said.begin() + static_cast<std::ptrdiff_t>(random() % said.size());
            switch (random() % 3) {
                case 0:
                    *at = static_cast<std::uint8_t>(random());
                    break;
                case 1:
                    said.erase(at, at + std::min<std::ptrdiff_t>(said.end() - at,
                                                                 static_cast<std::ptrdiff_t>(random() % 40)));
                    break;
                default:
                    said.insert(at, static_cast<std::uint8_t>(random() % 4));
            }
        }
        if (random() % 4 == 0) said.resize(random() % (said.size() + 1));
        {
            RedirHost host(peer, true);
            for (std::size_t from = 0; from < said.size();) {
                const std::size_t size = std::min<std::size_t>(1 + random() % 200, said.size() - from);
                const bool understood = host.receive(std::span(said).subspan(from, size));
                host.poll(now += 100us);
                host.take_output();
                from += size;
                if (understood) continue;
                EXPECT_FALSE(host.complaint().empty());
                ++refused;
                break;
            }
        }
        Wire wire(peer);
        wire.now = now;
        ASSERT_TRUE(wire.guest.device);
        const auto answer = wire.wait(wire.guest.control(0x80, 6, 0x0100, 0, 18));
        ASSERT_TRUE(answer);
        ASSERT_EQ(answer->data.size(), 18U);
        now = wire.now;
    }
    EXPECT_GT(refused, rounds / 20) << "hardly any of them was wrong";
    EXPECT_LT(refused, rounds);
}

TEST(RedirHostFuzz, NoBytesOfAGuestHurtTheFalcon) {
    FalconPeer peer(still(), {});
    survives_anything(peer, 2000, 20261122);
}

TEST(RedirHostFuzz, NoBytesOfAGuestHurtTheBridge) {
    Cp2112 peer;
    survives_anything(peer, 2000, 20261123);
}

}  // namespace
}  // namespace eddy::redir
