#include "gles/render/page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace eddy::gles {
namespace {

/// A composed page.
struct Seen {
    glm::ivec2 size;
    std::vector<std::uint8_t> rgba;

    int alpha(int x, int y) const { return rgba[4 * static_cast<std::size_t>(y * size.x + x) + 3]; }
    glm::ivec3 colour(int x, int y) const {
        const std::uint8_t* p = &rgba[4 * static_cast<std::size_t>(y * size.x + x)];
        return {p[0], p[1], p[2]};
    }
    /// Pixels' worth of ink.
    double area() const {
        double sum = 0.0;
        for (std::size_t i = 3; i < rgba.size(); i += 4) sum += rgba[i] / 255.0;
        return sum;
    }
    /// Columns and rows that hold any ink, half open.
    struct Extent {
        glm::ivec2 low{1 << 20}, high{-1};
    };
    Extent extent() const {
        Extent e;
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (alpha(x, y) > 0) {
                    e.low = glm::min(e.low, glm::ivec2(x, y));
                    e.high = glm::max(e.high, glm::ivec2(x, y) + 1);
                }
        return e;
    }
};

Seen seen(const Page& page) {
    static Font font;  // the same for all, which must make no difference
    return {page.size_px, compose(page, font)};
}

Seen line(const std::string& text, double size_px = 20.0, Align align = Align::Left,
          const glm::dvec2& at = {150.0, 60.0}) {
    return seen(
        {.size_px = {300, 100}, .lines = {{.text = text, .at_px = at, .size_px = size_px, .align = align}}});
}

TEST(TextLine, OfSpacesIsEmptyAndOfLettersIsNot) {
    EXPECT_EQ(line("").area(), 0.0);
    EXPECT_EQ(line("   ").area(), 0.0);
    EXPECT_GT(line("i").area(), 5.0);
}

TEST(TextLine, TwiceAsLargeCoversFourTimesTheArea) {
    const double small = line("Re", 20.0).area(), large = line("Re", 40.0).area();
    EXPECT_NEAR(large / small, 4.0, 0.1);
}

TEST(TextLine, IsAsWideAsItsLettersAre) {
    const Font font;
    EXPECT_LT(2.0 * font.width_px("ii", 20.0), font.width_px("WW", 20.0));
    EXPECT_NEAR(font.width_px("WW", 40.0), 2.0 * font.width_px("WW", 20.0), 1e-4);
    // The glyphs themselves, not only what is said of them.
    const auto narrow = line("ii").extent(), wide = line("WW").extent();
    EXPECT_LT(2 * (narrow.high.x - narrow.low.x), wide.high.x - wide.low.x);
    EXPECT_NEAR(wide.high.x - wide.low.x, font.width_px("WW", 20.0), 2.0);
}

TEST(TextLine, StandsOnItsBaseline) {
    // Antialiasing may reach into the next row.
    const auto e = line("H", 50.0).extent();
    EXPECT_NEAR(e.high.y, 60, 1);
    EXPECT_NEAR(e.low.y, 60 - 0.729 * 50.0, 1);  // DejaVu's capitals
    EXPECT_GT(line("g", 50.0).extent().high.y, 65);
}

TEST(TextLine, BeginsEndsOrHasItsMiddleWhereItIsToldTo) {
    const auto left = line("HHH", 30.0, Align::Left).extent(),
               right = line("HHH", 30.0, Align::Right).extent(),
               centre = line("HHH", 30.0, Align::Centre).extent();
    // An H has about 0.1 em free on each side.
    EXPECT_NEAR(left.low.x, 150 + 3, 1);
    EXPECT_NEAR(right.high.x, 150 - 3, 1);
    EXPECT_NEAR(centre.low.x + centre.high.x, 300, 2);
}

TEST(TextLine, StandsWithinAQuarterOfAPixelOfWhereItIsToldTo) {
    const auto middle = [](double x) {
        const Seen page = line("———", 15.0, Align::Left, {x, 60.0});
        double sum = 0.0;
        for (int row = 0; row < page.size.y; ++row)
            for (int column = 0; column < page.size.x; ++column)
                sum += page.alpha(column, row) / 255.0 * (column + 0.5);
        return sum / page.area();
    };
    for (int i = 0; i <= 12; ++i) EXPECT_NEAR(middle(40.0 + i / 12.0) - middle(40.0), i / 12.0, 0.145) << i;
    EXPECT_NEAR(middle(40.25) - middle(40.0), 0.25, 0.02);
}

TEST(TextLine, NumbersSetRightEndAtTheSameColumnToTheLastShade) {
    // At a place and a size at which no pen falls on a pixel.
    const auto set = [](const std::string& number) {
        return line(number, 17.3, Align::Right, {250.37, 60.0});
    };
    const Seen one = set("8"), many = set("-1234567.8");
    const int width = 9;  // of one digit, less what it has free on its left
    for (int y = 0; y < 100; ++y)
        for (int x = 250 - width; x < 300; ++x) ASSERT_EQ(one.alpha(x, y), many.alpha(x, y)) << x << "," << y;
    EXPECT_GT(one.area(), 10.0);
}

TEST(TextLine, OfEachSignOfAPhysicsPageIsAGlyphOfItsOwn) {
    const Font font;
    ASSERT_EQ(font.line("\U000E0001", 20.0).glyphs.at(0).index, 0);  // a code point that no font has
    const std::string signs = "²³·×−–…°µ≤≥√Δρν∇→∂±½¼∞≈≠€«»„“”‘’";
    for (const auto& glyph : font.line(signs, 20.0).glyphs) EXPECT_NE(glyph.index, 0) << glyph.pen;
    // All of Latin-1 and of Greek that is printed.
    std::string latin;
    for (int c = 0x20; c < 0x7F; ++c) latin += static_cast<char>(c);
    for (int c = 0xA0; c <= 0xFF; ++c)
        latin += {static_cast<char>(0xC0 | c >> 6), static_cast<char>(0x80 | (c & 0x3F))};
    for (int c = 0x391; c <= 0x3C9; ++c)
        if (c != 0x3A2)  // not assigned
            latin += {static_cast<char>(0xC0 | c >> 6), static_cast<char>(0x80 | (c & 0x3F))};
    for (const auto& glyph : font.line(latin, 20.0).glyphs) EXPECT_NE(glyph.index, 0) << glyph.pen;
}

TEST(TextLine, ShowsABoxForWhatTheFontLacksAndASignForBytesThatAreNoText) {
    const Seen box = line("\U000E0001", 40.0);
    EXPECT_GT(box.area(), 50.0);
    const auto e = box.extent();
    EXPECT_EQ(box.alpha((e.low.x + e.high.x) / 2, (e.low.y + e.high.y) / 2), 0) << "hollow";
    EXPECT_EQ(line("\xFF", 40.0).rgba, line("\uFFFD", 40.0).rgba);
    EXPECT_EQ(line("a\xE2\x88", 40.0).rgba, line("a\uFFFD\uFFFD", 40.0).rgba);
    EXPECT_GT(line("\xFF", 40.0).area(), 50.0);
}

TEST(TextLine, OfAnyBytesIsDrawn) {
    std::mt19937 chance(3);
    Font font;
    for (int i = 0; i < 200; ++i) {
        std::string bytes(1 + chance() % 30, '\0');
        for (char& byte : bytes) byte = static_cast<char>(chance());
        const Page page{.size_px = {200, 40}, .lines = {{.text = bytes, .at_px = {5.0, 30.0}}}};
        EXPECT_EQ(compose(page, font).size(), 4u * 200 * 40);
    }
}

TEST(TextLine, PastTheEdgeIsCutAndAppearsOnNoOtherLine) {
    const std::string text(60, 'M');
    const Seen whole = seen({.size_px = {2000, 100}, .lines = {{.text = text, .at_px = {150.0, 60.0}}}});
    const Seen cut = line(text, 16.0);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 300; ++x) ASSERT_EQ(cut.alpha(x, y), whole.alpha(x, y)) << x << "," << y;
    EXPECT_GT(cut.alpha(299, 55) + cut.alpha(298, 55) + cut.alpha(295, 55), 0);
    // Over each edge, and wholly outside.
    for (const glm::dvec2& at : {glm::dvec2(-30.0, 60.0), {150.0, 5.0}, {150.0, 110.0}, {290.0, 60.0}})
        EXPECT_GT(line("MMMMM", 40.0, Align::Left, at).area(), 0.0) << at.x << "," << at.y;
    for (const glm::dvec2& at : {glm::dvec2(-900.0, 60.0),
                                 {150.0, -5.0},
                                 {150.0, 200.0},
                                 {1e300, 60.0},
                                 {-1e300, 60.0},
                                 {150.0, 1e300},
                                 {std::numeric_limits<double>::quiet_NaN(), 60.0}})
        EXPECT_EQ(line("MMMMM", 40.0, Align::Left, at).area(), 0.0) << at.x << "," << at.y;
}

TEST(TextLine, OfASizeThatIsNoneIsEmptyAndOfAnEnormousOneIsTheLargest) {
    for (const double size : {0.0, -5.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(line("M", size).area(), 0.0);
    EXPECT_EQ(line("M", 1e30).rgba, line("M", Font::kLargestPx).rgba);
}

TEST(TextLine, IsAsStrongAsItsOpacity) {
    const auto with = [](double opacity) {
        return seen(
                   {.size_px = {300, 100},
                    .lines = {{.text = "Force", .at_px = {20.0, 60.0}, .size_px = 40.0, .opacity = opacity}}})
            .area();
    };
    EXPECT_NEAR(with(0.25) / with(1.0), 0.25, 0.01);
    EXPECT_EQ(with(0.0), 0.0);
}

TEST(PageBox, FillsItsPixelsAndNoOthers) {
    const Seen page =
        seen({.size_px = {20, 10},
              .boxes = {{.low_px = {2.4, 3.0}, .high_px = {9.6, 5.0}, .colour = {1.0, 0.5, 0.0}}}});
    EXPECT_EQ(page.area(), 8.0 * 2.0);
    EXPECT_EQ(page.extent().low, glm::ivec2(2, 3));
    EXPECT_EQ(page.extent().high, glm::ivec2(10, 5));
    EXPECT_EQ(page.colour(4, 4), glm::ivec3(255, 128, 0));
    // Of lengths that are none, nothing; of one that is too long, what fits.
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(seen({.size_px = {20, 10}, .boxes = {{.high_px = {nan, 5.0}}}}).area(), 0.0);
    EXPECT_EQ(seen({.size_px = {20, 10}, .boxes = {{.low_px = {5.0, 5.0}, .high_px = {2.0, 8.0}}}}).area(),
              0.0);
    EXPECT_EQ(
        seen({.size_px = {20, 10}, .boxes = {{.low_px = glm::dvec2(-1e300), .high_px = glm::dvec2(1e300)}}})
            .area(),
        200.0);
}

TEST(Page, LaysLaterBoxesOverEarlierOnesAndWordsOverAll) {
    const PageBox red{.high_px = {20.0, 20.0}, .colour = {1.0, 0.0, 0.0}},
        half_blue{.high_px = {20.0, 20.0}, .colour = {0.0, 0.0, 1.0}, .opacity = 0.5};
    const Seen page = seen({.size_px = {20, 20},
                            .boxes = {red, half_blue},
                            .lines = {{.text = "█", .at_px = {0.0, 20.0}, .size_px = 8.0}}});
    EXPECT_EQ(page.colour(15, 5), glm::ivec3(127, 0, 128));
    EXPECT_EQ(page.alpha(15, 5), 255);
    EXPECT_EQ(page.colour(2, 17), glm::ivec3(255));
}

TEST(Page, WithNothingOnItIsEmpty) {
    Font font;
    EXPECT_TRUE(Page{.size_px = glm::ivec2(10, 10)}.empty());
    const Page flat{.size_px = {0, 10}, .boxes = {PageBox{}}};
    EXPECT_TRUE(flat.empty());
    EXPECT_TRUE(compose(flat, font).empty());
}

}  // namespace
}  // namespace eddy::gles
