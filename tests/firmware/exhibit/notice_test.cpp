#include "firmware/exhibit/notice.h"

#include "firmware/exhibit/wrapped.h"
#include "gles/render/window.h"
#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

class NoticeTest : public gles::GlTest {
  protected:
    Notice notice{gpu};

    std::vector<std::uint8_t> drawn(const std::vector<std::string>& lines, Instant now) {
        notice.draw(lines, now);
        return gles::rgb_from_top(gpu, notice.picture());
    }
    static double lit(const std::vector<std::uint8_t>& rgb) {
        double sum = 0.0;
        for (const std::uint8_t value : rgb) sum += value / 255.0;
        return sum / static_cast<double>(rgb.size());
    }
};

TEST_F(NoticeTest, ShowsItsWords) {
    const double none = lit(drawn({}, 0s));
    const double title = lit(drawn({"Eddy is closed"}, 0s));
    const double more = lit(drawn({"Eddy is closed", "It opens tomorrow at 9:00."}, 0s));
    EXPECT_GT(title, none + 0.001);
    EXPECT_GT(more, title + 0.001);
}

TEST_F(NoticeTest, MovesAsLongAsTheMachineLives) {
    const auto at = [&](Instant now) { return drawn({"Eddy is starting"}, now); };
    const std::vector<std::uint8_t> first = at(0ms);
    EXPECT_NE(first, at(100ms));
    EXPECT_EQ(first, at(4s)) << "there and back";
}

TEST_F(NoticeTest, SaysHowFarItIsIfThatIsKnown) {
    const auto at = [&](std::optional<double> done) {
        notice.draw({"Eddy is starting"}, 0s, done);
        return lit(gles::rgb_from_top(gpu, notice.picture()));
    };
    const double unknown = at({}), none = at(0.0), half = at(0.5), all = at(1.0);
    EXPECT_GT(none, unknown) << "the way to go";
    EXPECT_GT(half, none);
    EXPECT_NEAR(all - half, half - none, 0.02 * (all - none)) << "as long as what is done";
    EXPECT_EQ(at(7.0), all);
    EXPECT_EQ(at({}), unknown);
}

TEST_F(NoticeTest, DrawsItsWordsOnlyWhenTheyAreOthers) {
    std::vector<gles::PassRecord> passes;
    drawn({"Eddy is starting"}, 0s);
    gpu.record(&passes);
    drawn({"Eddy is starting"}, 1s);
    EXPECT_TRUE(passes.empty()) << "what moves needs no shader";
    drawn({"Eddy is closed"}, 1s);
    gpu.record(nullptr);
    EXPECT_EQ(passes.size(), 1u);
}

TEST(Wrapped, BreaksWhereALineIsFullAndLosesNoWord) {
    const std::string words = "The driver has no OpenGL ES 3: look into the log";
    std::string joined;
    for (const std::string& line : wrapped(words, 8.0)) {
        EXPECT_LE(gles::Font().width_px(line, 1.0), 8.0) << line;
        joined += (joined.empty() ? "" : " ") + line;
    }
    EXPECT_EQ(joined, words);
    EXPECT_TRUE(wrapped("", 8.0).empty());
    EXPECT_EQ(wrapped("incomprehensibilities", 2.0).size(), 1u);
}

}  // namespace
}  // namespace eddy
