#include "gles/render/utf8.h"

#include <gtest/gtest.h>

#include <random>

namespace eddy::gles {
namespace {

TEST(Utf8, GivesTheCodePointsOfGoodText) {
    EXPECT_EQ(code_points(""), U"");
    EXPECT_EQ(code_points("Re 10²"), U"Re 10²");
    EXPECT_EQ(code_points("∇·u ≤ ρ"), U"∇·u ≤ ρ");
    EXPECT_EQ(code_points("\U0001F30A\U0010FFFF"), U"\U0001F30A\U0010FFFF");
    EXPECT_EQ(code_points(std::string_view("\0a", 2)), std::u32string_view(U"\0a", 2));
}

TEST(Utf8, ReplacesEachByteThatBelongsToNothing) {
    EXPECT_EQ(code_points("a\x80z"), U"a\uFFFDz");                       // goes on with nothing
    EXPECT_EQ(code_points("\xC2"), U"\uFFFD");                           // ends too early
    EXPECT_EQ(code_points(std::string_view("\xC2\xB2", 1)), U"\uFFFD");  // the same, whatever lies behind
    EXPECT_EQ(code_points("\xE2\x88z"), U"\uFFFD\uFFFDz");               // the same, before a letter
    EXPECT_EQ(code_points("\xC0\xAF"), U"\uFFFD\uFFFD");                 // '/' in a longer form than needed
    EXPECT_EQ(code_points("\xE0\x80\xAF"), U"\uFFFD\uFFFD\uFFFD");       // and in a longer one still
    EXPECT_EQ(code_points("\xED\xA0\x80"), U"\uFFFD\uFFFD\uFFFD");       // a surrogate
    EXPECT_EQ(code_points("\xF4\x90\x80\x80"), U"\uFFFD\uFFFD\uFFFD\uFFFD");  // above 10FFFF
    EXPECT_EQ(code_points("\xFF\xFE"), U"\uFFFD\uFFFD");                      // never in UTF-8
}

TEST(Utf8, OfAnyBytesHoldsOnlyCodePointsThatExist) {
    std::mt19937 chance(7);
    for (int i = 0; i < 2000; ++i) {
        std::string bytes(chance() % 40, '\0');
        // Mostly bytes that begin something or go on with it.
        for (char& byte : bytes) byte = static_cast<char>(chance() % 3 == 0 ? chance() : 0x80 | chance());
        const std::u32string points = code_points(bytes);
        EXPECT_LE(points.size(), bytes.size());
        for (const char32_t point : points) {
            EXPECT_LE(point, 0x10FFFFu);
            EXPECT_TRUE(point < 0xD800 || point > 0xDFFF);
        }
    }
}

}  // namespace
}  // namespace eddy::gles
