#include "firmware/exhibit/visitors.h"

#include <gtest/gtest.h>

#include "firmware/rest_watch.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

/// A day at the exhibit: the handle is at a place, or away.
class VisitorsTest : public testing::Test {
  protected:
    Visitors::News look(Instant now, std::optional<glm::dvec3> hand, std::uint8_t buttons = 0) {
        watch_.see(now, hand, buttons);
        return visitors_.see(now, watch_.untouched());
    }
    RestWatch watch_{0.1};
    Visitors visitors_{45s};
    const glm::dvec3 here_{0.0, 0.0, 0.0}, there_{0.01, 0.0, 0.0};
};

TEST_F(VisitorsTest, NobodyHasComeBeforeAHandMoves) {
    for (Instant t = 0s; t < 100s; t += 1s) {
        EXPECT_FALSE(look(t, here_).came);
        EXPECT_EQ(visitors_.presence(), Presence::Nobody);
    }
    EXPECT_TRUE(look(100s, there_).came);
    EXPECT_EQ(visitors_.presence(), Presence::Here);
}

TEST_F(VisitorsTest, ADeviceThatComesOrGoesIsNobody) {
    look(0s, std::nullopt);
    EXPECT_FALSE(look(3s, here_).came);
    EXPECT_FALSE(look(5s, std::nullopt).came);
    EXPECT_FALSE(look(9s, there_).came);
}

TEST_F(VisitorsTest, WhoeverTouchesItWhileItIsClosedIsNone) {
    look(0s, here_);
    for (Instant t = 1s; t < 10h; t += 60s) {
        watch_.see(t, t < 5h ? here_ : there_, 0);  // it sank, or was cleaned
        visitors_.closed(t);
    }
    EXPECT_FALSE(look(10h, there_).came);
    EXPECT_FALSE(look(10h + 1s, there_).gone);
    EXPECT_TRUE(look(10h + 2s, here_).came);
}

TEST_F(VisitorsTest, AButtonIsATouch) {
    look(0s, here_);
    EXPECT_TRUE(look(1s, here_, 1).came);
}

TEST_F(VisitorsTest, AreWarnedTenSecondsBeforeTheyCountAsGone) {
    look(0s, here_);
    look(1s, there_);
    look(5s, here_);  // the last touch
    for (Instant t = 6s; t < 40s; t += 1s) {
        EXPECT_FALSE(look(t, here_).gone) << t.count();
        EXPECT_EQ(visitors_.presence(), Presence::Here) << t.count();
    }
    EXPECT_FALSE(look(40s, here_).gone);
    EXPECT_EQ(visitors_.presence(), Presence::Leaving);
    const Visitors::News news = look(50s, here_);
    EXPECT_TRUE(news.gone);
    EXPECT_EQ(news.dwell, Seconds(4.0)) << "from the first touch to the last";
    EXPECT_EQ(visitors_.presence(), Presence::Nobody);
    EXPECT_FALSE(look(51s, here_).gone) << "said once";
}

TEST_F(VisitorsTest, OneWhoWasWarnedAndTouchesStaysTheSameVisitor) {
    look(0s, here_);
    look(1s, there_);
    look(40s, there_);
    const Visitors::News news = look(41s, here_);
    EXPECT_FALSE(news.came);
    EXPECT_EQ(visitors_.presence(), Presence::Here);
}

TEST_F(VisitorsTest, TheNextOneIsCounted) {
    look(0s, here_);
    int came = 0;
    for (int visit = 0; visit < 5; ++visit) {
        const Instant begin = visit * 100s + 1s;
        came += look(begin, visit % 2 ? here_ : there_).came;
        look(begin + 50s, visit % 2 ? here_ : there_);
    }
    EXPECT_EQ(came, 5);
}

TEST_F(VisitorsTest, ANewSceneMakesNobodyLeave) {
    look(0s, here_);
    look(10s, there_);
    watch_ = RestWatch(0.1);  // the scene is another
    const Visitors::News news = look(12s, there_);
    EXPECT_FALSE(news.gone || news.came);
    EXPECT_EQ(visitors_.presence(), Presence::Here);
}

TEST(VisitorsShort, AShortTimeStillHasATimeWithoutWarning) {
    Visitors visitors(10s);
    EXPECT_TRUE(visitors.see(100s, 0s).came);
    visitors.see(104s, 4s);
    EXPECT_EQ(visitors.presence(), Presence::Here);
    visitors.see(105s, 5s);
    EXPECT_EQ(visitors.presence(), Presence::Leaving);
    EXPECT_TRUE(visitors.see(110s, 10s).gone);
}

}  // namespace
}  // namespace eddy
