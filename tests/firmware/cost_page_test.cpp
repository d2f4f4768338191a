#include "firmware/cost_page.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace eddy {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

CostFigures some_figures() {
    CostFigures f;
    f.preset = "fast";
    f.cells = {48, 40, 32};
    f.iterations = "2 cycles";
    f.steps_per_s = 47.6;
    f.target_steps_per_s = 50.0;
    f.divergence_before_1_s = 12.0;
    f.divergence_after_1_s = 0.03;
    f.stages = {{"divergence", 2.5}, {"pressure", 13.0}, {"project", 4.6}};
    f.step_ms = 20.1;
    return f;
}

/// All words of a page, line by line.
std::vector<std::string> words_of(const gles::Page& page) {
    std::vector<std::string> words;
    for (const gles::TextLine& line : page.lines) words.push_back(line.text);
    return words;
}
std::vector<std::string> words_of(const CostFigures& figures) {
    return words_of(cost_page(figures, {1280, 720}));
}

TEST(CostPage, SaysWhatIsMeasured) {
    CostFigures f = some_figures();
    f.force_error = 0.0123;
    f.ripple = {0.0125, 0.0042};
    f.quality_down = 2;
    const std::vector<std::string> words = words_of(f);
    for (const char* said : {"Force within about 1 %", "0.4 % of it, 0.013 N", "48 × 40 × 32 cells",
                             "fast, 2 cycles a step", "48 of 50 steps a second", "12 → 0.030 1/s (÷ 400)",
                             "2 × down, 0 × up", "20 ms a step", "pressure", "13.0", "2.5"})
        EXPECT_THAT(words, Contains(said));
}

TEST(CostPage, SaysWhatIsNotKnown) {
    const std::vector<std::string> words = words_of(some_figures());
    EXPECT_THAT(words, Contains("Force error not measured yet"));
    EXPECT_THAT(words, Contains("not known yet"));
    EXPECT_THAT(words_of(CostFigures{}), Contains("Time of a step not known yet"));
    EXPECT_THAT(words, Not(Contains(HasSubstr("within"))));
}

TEST(CostPage, SaysWhyTheQualityIsWhatItIs) {
    CostFigures f = some_figures();
    const std::size_t lines = words_of(f).size();
    f.quality_note = "steps took 24.3 ms, 20 are allowed";
    EXPECT_THAT(words_of(f), Contains("steps took 24.3 ms, 20 are allowed"));
    EXPECT_EQ(words_of(f).size(), lines + 1);
}

TEST(CostPage, CutsANoteThatIsTooLongForItBetweenLetters) {
    CostFigures f = some_figures();
    f.quality_note = "not tuned: /var/lib/eddy/tuning-jet.json is of another renderer, a very long name";
    EXPECT_THAT(words_of(f), Contains(testing::StartsWith("not tuned: /var/lib/eddy/tun")));
    EXPECT_THAT(words_of(f), Contains(testing::EndsWith("…")));
    // A letter of two bytes, wider than the sign for half of it.
    f.quality_note.clear();
    for (int i = 0; i < 40; ++i) f.quality_note += "Ǆ";
    for (int i = 0; i < 8; ++i, f.quality_note = "i" + f.quality_note)
        EXPECT_THAT(words_of(f), Contains(testing::EndsWith("Ǆ…")));
}

TEST(CostPage, CallsAnErrorByOneFigureAndNeverByNone) {
    const std::pair<double, const char*> errors[] = {
        {0.35, "35 %"}, {0.02, "2 %"}, {0.0096, "1 %"}, {0.0004, "0.04 %"}, {1e-6, "less than 0.01 %"}};
    for (const auto& [error, said] : errors) {
        CostFigures f = some_figures();
        f.force_error = error;
        EXPECT_THAT(words_of(f), Contains(fmt::format("Force within about {}", said)));
    }
}

TEST(CostPage, OfTimesInMicrosecondsHasTwoDecimals) {
    CostFigures f = some_figures();
    for (CostFigures::Stage& stage : f.stages) stage.ms /= 20.0;
    f.step_ms /= 20.0;
    EXPECT_THAT(words_of(f), Contains("0.65"));
    EXPECT_THAT(words_of(f), Contains("1.0 ms a step"));
}

TEST(CostPage, ShowsTheLongestStagesFirstAndAddsUpTheRest) {
    CostFigures f = some_figures();
    f.stages.clear();
    for (int i = 0; i < 12; ++i) f.stages.push_back({fmt::format("stage {}", i), 1.0 + i});
    f.step_ms = 78.0;
    const std::vector<std::string> words = words_of(f);
    const auto place = [&](const std::string& word) {
        return std::find(words.begin(), words.end(), word) - words.begin();
    };
    EXPECT_LT(place("stage 11"), place("stage 10"));
    EXPECT_LT(place("stage 5"), place("5 more"));
    EXPECT_THAT(words, Not(Contains("stage 4")));
    EXPECT_THAT(words, Contains("15.0"));  // 1 + 2 + 3 + 4 + 5
    // One more than there is room for is shown by its name: a bar for "1 more" takes no less.
    f.stages.resize(8);
    EXPECT_THAT(words_of(f), Contains("stage 0"));
}

TEST(CostPage, HasBarsAsLongAsTheirStagesTake) {
    const gles::Page page = cost_page(some_figures(), {1920, 1080});
    ASSERT_EQ(page.boxes.size(), 4u);  // the panel, and a bar a stage
    const auto length = [&](std::size_t i) { return page.boxes[i].high_px.x - page.boxes[i].low_px.x; };
    EXPECT_NEAR(length(2) / length(1), 4.6 / 13.0, 1e-9);
    EXPECT_NEAR(length(3) / length(1), 2.5 / 13.0, 1e-9);
    EXPECT_NEAR(length(1), 0.43 * page.size_px.x, 0.02 * page.size_px.x);
}

TEST(CostPage, OfAPictureHasItsTimeBesideTheStep) {
    CostFigures f = some_figures();
    EXPECT_THAT(words_of(f), Not(Contains("(picture)")));
    f.picture_ms = 33.3;
    const gles::Page page = cost_page(f, {1280, 720});
    EXPECT_THAT(words_of(page), Contains("33.3"));
    EXPECT_EQ(page.boxes.size(), 4u) << "it is no part of the step: no bar";
}

TEST(CostPage, HasItsNumbersInOneColumn) {
    const gles::Page page = cost_page(some_figures(), {1280, 720});
    std::vector<double> ends;
    for (const gles::TextLine& line : page.lines)
        if (line.align == gles::Align::Right) ends.push_back(line.at_px.x);
    EXPECT_EQ(ends.size(), 3u);
    EXPECT_EQ(std::count(ends.begin(), ends.end(), ends.front()), 3);
}

TEST(CostPage, FitsIntoEveryPictureWithAllItsWordsInside) {
    CostFigures f = some_figures();
    f.cells = {256, 256, 256};
    f.preset = "yang2009";
    f.iterations = "1000 sweeps";
    f.ripple = {0.000123, 0.00001};
    f.divergence_before_1_s = 1.23e-7;
    f.divergence_after_1_s = 1.23e-11;
    f.quality_down = f.quality_up = 9999;
    f.quality_note = std::string(100, 'W');
    f.stages.clear();
    for (int i = 0; i < 12; ++i) f.stages.push_back({"advect velocity", 999.9});
    f.step_ms = 9999.9;
    f.picture_ms = 999.9;
    const gles::Font font;
    for (const glm::ivec2 picture :
         {glm::ivec2(640, 480), {1280, 720}, {1920, 1080}, {3840, 2160}, {1080, 1920}, {320, 240}}) {
        const gles::Page page = cost_page(f, picture);
        EXPECT_LE(page.size_px.x, picture.x);
        EXPECT_LE(page.size_px.y, picture.y);
        for (const gles::TextLine& line : page.lines) {
            const double width = font.width_px(line.text, line.size_px);
            const double left = line.align == gles::Align::Right ? line.at_px.x - width : line.at_px.x;
            EXPECT_GE(left, 0.0) << line.text;
            EXPECT_LE(left + width, page.size_px.x) << line.text << " at " << picture.x;
            EXPECT_GE(line.at_px.y - 0.9 * line.size_px, 0.0) << line.text;
            EXPECT_LE(line.at_px.y + 0.3 * line.size_px, page.size_px.y) << line.text;
            // No word lies on a bar; bars begin after the stages' names.
            for (std::size_t i = 1; i < page.boxes.size(); ++i) {
                const gles::PageBox& bar = page.boxes[i];
                if (line.at_px.y > bar.low_px.y && line.at_px.y - 0.7 * line.size_px < bar.high_px.y) {
                    EXPECT_TRUE(left + width <= bar.low_px.x || left >= bar.high_px.x) << line.text;
                }
            }
        }
    }
}

TEST(CostPage, IsReadFromTwoMetresOnAScreenOf1080Lines) {
    // Capitals of DejaVu Sans are 0.73 em high, a 24 inch screen 299 mm. Letters of 5 minutes of arc are what a good eye
    // (6/6) just makes out; these have at least 10.
    const gles::Page page = cost_page(some_figures(), {1920, 1080});
    for (const gles::TextLine& line : page.lines)
        EXPECT_GT(0.73 * line.size_px * 0.299 / 1080.0, 2.0 * 10.0 / 3437.75) << line.text;
}

}  // namespace
}  // namespace eddy
