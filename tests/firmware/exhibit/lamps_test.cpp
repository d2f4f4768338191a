#include "firmware/exhibit/lamps.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <set>
#include <vector>

namespace eddy {
namespace {

using namespace std::chrono_literals;

constexpr Instant kLook = 10ms;
/// WCAG 2.3.1: no more than three flashes in any one second.
constexpr int kMostFlashes = 3;

/// What one light does, tick by tick: the most times it comes on in any one second.
class FlashCount {
  public:
    void see(Instant now, bool on) {
        if (on && !on_) rises_.push_back(now);
        on_ = on;
        while (!rises_.empty() && now - rises_.front() >= 1s) rises_.erase(rises_.begin());
        most_ = std::max(most_, static_cast<int>(rises_.size()));
    }
    int most() const { return most_; }

  private:
    bool on_ = false;
    std::vector<Instant> rises_;
    int most_ = 0;
};

/// Of all the lights there are, and of all of them taken for one.
struct FlashCounts {
    FlashCount green, amber, red, any, one, ring_red, ring_green, ring_blue, ring_any;

    void see(Instant now, LampCode code, Instant shown) {
        const LampStates states = lamps(code, shown);
        green.see(now, states.green);
        amber.see(now, states.amber);
        red.see(now, states.red);
        any.see(now, states.green || states.amber || states.red);
        one.see(now, lamp(code, shown));
        const HandleLight light = ring(code, shown);
        ring_red.see(now, light.red);
        ring_green.see(now, light.green);
        ring_blue.see(now, light.blue);
        ring_any.see(now, light.red || light.green || light.blue);
    }
    int most() const {
        int most = 0;
        for (const FlashCount* each :
             {&green, &amber, &red, &any, &one, &ring_red, &ring_green, &ring_blue, &ring_any})
            most = std::max(most, each->most());
        return most;
    }
};

TEST(Lamps, NoCodeFlashesMoreThanThreeTimesInAnySecond) {
    int most = 0;
    for (const LampRow& row : kLampRows) {
        FlashCounts counts;
        for (Instant now{0}; now < 30s; now += kLook) counts.see(now, row.code, now);
        EXPECT_LE(counts.most(), kMostFlashes) << row.word;
        most = std::max(most, counts.most());
    }
    EXPECT_GT(most, 1) << "or nothing was counted";
}

TEST(Lamps, DoNotFlashFasterHoweverTheCodesChange) {
    std::mt19937 chance(7);
    for (const Instant longest : {Instant(20ms), Instant(400ms), Instant(3s)}) {
        LampPlayer player;
        FlashCounts counts;
        Instant next{0};
        std::set<LampCode> seen;
        for (Instant now{0}; now < 600s; now += kLook) {
            if (now >= next) {
                player.show(kLampRows[chance() % kLampRows.size()].code);
                next = now + Instant(static_cast<std::int64_t>(chance()) % longest.count());
            }
            player.advance(now);
            seen.insert(player.code());
            counts.see(now, player.code(), player.shown());
        }
        EXPECT_LE(counts.most(), kMostFlashes);
        EXPECT_EQ(seen.size(), kLampRows.size());
    }
}

TEST(Lamps, ShowANewCodeWithinAQuarterOfASecondFromItsBeginning) {
    for (Instant at{1s}; at < 2s; at += 37ms) {
        LampPlayer player;
        player.show(LampCode::Show);
        for (Instant now{0}; now < at; now += kLook) player.advance(now);
        player.show(LampCode::Guide);
        Instant waited{0};
        for (; player.code() != LampCode::Guide; waited += kLook) player.advance(at + waited);
        EXPECT_LE(waited, kLampStep + kLook);
        EXPECT_EQ(player.shown(), Instant(0));
    }
}

/// What somebody sees who looks for half a minute, whenever they begin.
std::string seen(const std::function<char(Instant)>& light) {
    std::string least;
    for (Instant from{0}; from < 8s; from += kLampStep) {
        std::string now;
        for (Instant t{0}; t < 30s; t += kLampStep) now += light(from + t);
        if (least.empty() || now < least) least = now;
    }
    return least;
}

TEST(Lamps, NoTwoCodesLookTheSameOnThreeLampsOnOneAndOnTheRing) {
    std::set<std::string> three, one, rings, words;
    for (const LampRow& row : kLampRows) {
        words.insert(std::string(row.word));
        three.insert(seen([&](Instant t) {
            const LampStates s = lamps(row.code, t);
            return static_cast<char>('0' + s.green + 2 * s.amber + 4 * s.red);
        }));
        one.insert(seen([&](Instant t) { return lamp(row.code, t) ? '1' : '0'; }));
        rings.insert(seen([&](Instant t) {
            const HandleLight s = ring(row.code, t);
            return static_cast<char>('0' + s.red + 2 * s.green + 4 * s.blue);
        }));
    }
    EXPECT_EQ(words.size(), kLampRows.size());
    EXPECT_EQ(three.size(), kLampRows.size());
    EXPECT_EQ(one.size(), kLampRows.size());
    EXPECT_EQ(rings.size(), kLampRows.size());
}

TEST(Lamps, AllDarkMeansThatNothingRunsUnlessThereIsOneLampAndAFingerOnTheButton) {
    const auto ever = [](const std::function<bool(Instant)>& lit) {
        for (Instant t{0}; t < 8s; t += kLampStep)
            if (lit(t)) return true;
        return false;
    };
    for (const LampRow& row : kLampRows) {
        EXPECT_TRUE(ever([&](Instant t) { return lamps(row.code, t) != LampStates{}; })) << row.word;
        EXPECT_TRUE(ever([&](Instant t) { return ring(row.code, t) != HandleLight{}; })) << row.word;
        EXPECT_EQ(ever([&](Instant t) { return lamp(row.code, t); }), row.code != LampCode::LetGo)
            << row.word;
    }
}

TEST(Lamps, RedIsForStopAndFaultAlone) {
    for (const LampRow& row : kLampRows)
        if (row.code != LampCode::ShuttingDown && row.code != LampCode::LetGo) {
            bool red = false;
            for (Instant t{0}; t < 8s; t += kLampStep) red |= lamps(row.code, t).red;
            EXPECT_EQ(red, row.code == LampCode::Stopped || row.code == LampCode::Fault) << row.word;
        }
}

}  // namespace
}  // namespace eddy
