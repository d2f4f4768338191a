#include "hal/haptic/falcon/exchange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

namespace eddy::falcon {
namespace {

using namespace std::chrono_literals;

/// A line on which everything sent arrives, and replies come when the test says so.
class Line final : public Transport {
  public:
    void reply(int count) {
        const Frame frame = encode(Reply{.encoders = {count, count, count}});
        Packet packet;
        std::copy(frame.begin(), frame.end(), packet.bytes.begin() + 2);
        packet.size = 2 + frame.size();
        packets_.push_back(packet);
    }
    int sent = 0;

    void poll(Instant) override {}
    bool present() const override { return true; }
    std::string_view serial() const override { return "LINE"; }
    Obstacle obstacle() const override { return Obstacle::NotFound; }
    std::uint64_t failures() const override { return 0; }
    void submit_control(const ControlRequest&) override {}
    Transfer control() const override { return Transfer::Done; }
    void submit_out(std::span<const std::uint8_t>) override { ++sent; }
    Transfer out() const override { return Transfer::Done; }
    bool take_in(Packet& packet) override {
        if (packets_.empty()) return false;
        packet = packets_.front();
        packets_.pop_front();
        return true;
    }
    void close(std::span<const std::uint8_t>) override {}

  private:
    std::deque<Packet> packets_;
};

class FalconExchange : public testing::Test {
  protected:
    /// A millisecond passes; a command goes whenever one may.
    void tick() {
        newest_ = exchange_.poll(now_ += 1ms);
        if (exchange_.free()) exchange_.send({}, now_);
    }
    void ticks(int count) {
        for (; count > 0; --count) tick();
    }
    void become_trusted() {
        tick();
        for (int i = 0; i < Exchange::kTimely; ++i) {
            line_.reply(i);
            tick();
        }
        ASSERT_TRUE(exchange_.trusted());
    }

    Line line_;
    Exchange exchange_{line_};
    Instant now_{0};
    std::optional<Reply> newest_;
};

TEST_F(FalconExchange, IsTrustedAfterFiveRepliesInARow) {
    tick();
    for (int i = 0; i < Exchange::kTimely; ++i) {
        EXPECT_FALSE(exchange_.trusted());
        line_.reply(i);
        tick();
        ASSERT_TRUE(newest_);
        EXPECT_EQ(newest_->encoders[0], i);
    }
    EXPECT_TRUE(exchange_.trusted());
}

TEST_F(FalconExchange, IsNotTrustedAfterAMiss) {
    become_trusted();
    ticks(10);
    EXPECT_EQ(exchange_.misses(), 1);
    EXPECT_FALSE(exchange_.trusted());
}

TEST_F(FalconExchange, AsksNothingMoreUntilLateRepliesHaveAllCome) {
    become_trusted();
    ticks(14);  // missed, purged and asked again: two are unanswered
    const int sent = line_.sent;
    ASSERT_EQ(exchange_.misses(), 1);
    line_.reply(1);  // of which?
    ticks(14);
    EXPECT_EQ(line_.sent, sent);
    line_.reply(2);
    ticks(14);
    EXPECT_EQ(line_.sent, sent) << "there may be more";
    ticks(2);
    EXPECT_EQ(line_.sent, sent + 1);
    EXPECT_FALSE(exchange_.trusted());
}

TEST_F(FalconExchange, IsSilentForAWhileAfterAReplyThatCameTwice) {
    become_trusted();
    const int sent = line_.sent;
    line_.reply(1);
    line_.reply(1);
    ticks(14);
    EXPECT_FALSE(exchange_.trusted());
    EXPECT_EQ(line_.sent, sent);
    ticks(2);
    EXPECT_EQ(line_.sent, sent + 1);
}

TEST_F(FalconExchange, DistrustsAReplyThatNobodyAskedFor) {
    become_trusted();
    line_.reply(6);
    exchange_.poll(now_ += 1ms);
    ASSERT_TRUE(exchange_.free());
    line_.reply(7);
    exchange_.poll(now_ += 1ms);
    EXPECT_FALSE(exchange_.free());
    EXPECT_FALSE(exchange_.trusted());
}

}  // namespace
}  // namespace eddy::falcon
