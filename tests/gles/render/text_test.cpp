#include "gles/render/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/gles/render/rig.h"

namespace eddy::gles {
namespace {

using testing::ElementsAre;

/// A picture of one grey, 0 .. 1, and what became of it.
class WrittenOver : public GlTest {
  protected:
    static constexpr int kWidth = 120, kHeight = 80;

    Texture picture{{kWidth, kHeight}, Format::RGBA8, false};

    void fill(double grey) {
        std::vector<std::uint8_t> texels(4 * kWidth * kHeight,
                                         static_cast<std::uint8_t>(std::lround(255 * grey)));
        for (std::size_t i = 3; i < texels.size(); i += 4) texels[i] = 255;
        picture.upload(texels.data());
    }
    /// Display values; (0, 0) at the top left.
    std::vector<glm::dvec3> rows_from_top() const {
        const std::vector<glm::vec4> texels = download_bytes();
        std::vector<glm::dvec3> pixels;
        for (int y = kHeight - 1; y >= 0; --y)
            for (int x = 0; x < kWidth; ++x)
                pixels.emplace_back(texels[static_cast<std::size_t>(y * kWidth + x)]);
        return pixels;
    }
    static glm::dvec3 at(const std::vector<glm::dvec3>& pixels, int x, int y) {
        return pixels[static_cast<std::size_t>(y * kWidth + x)];
    }

  private:
    std::vector<glm::vec4> download_bytes() const {
        // A float copy: what a driver reads back of RGBA8 is bytes.
        Field<Cells> copy(gpu, {kWidth, kHeight, 1}, Format::RGBA32F);
        Pass pass(gpu, "copy", "gles/copy.frag", copy.layout());
        pass.draw({{"field", &picture}}, {}, {&copy.texture()});
        return copy.texture().download();
    }
};

/// Relative luminance of an sRGB colour and contrast of two (WCAG 2.2, "relative luminance", "contrast ratio").
double luminance(const glm::dvec3& c) {
    const auto light = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    return 0.2126 * light(c.x) + 0.7152 * light(c.y) + 0.0722 * light(c.z);
}
double contrast(const glm::dvec3& a, const glm::dvec3& b) {
    const double la = luminance(a), lb = luminance(b);
    return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

TEST_F(WrittenOver, LeavesThePictureAsItWasBesideTheWords) {
    fill(0.5);
    const auto before = rows_from_top();
    Text text(gpu, picture);
    const Page page{.corner_px = {10, 20},
                    .size_px = {60, 30},
                    .lines = {{.text = "Hg", .at_px = {5.0, 20.0}, .size_px = 20.0}}};
    text.draw(page);
    const auto after = rows_from_top();
    Font font;
    const std::vector<std::uint8_t> rgba = compose(page, font);
    int inked = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::ivec2 on_page = glm::ivec2(x, y) - page.corner_px;
            double alpha = 0.0;
            if (on_page.x >= 0 && on_page.y >= 0 && on_page.x < 60 && on_page.y < 30)
                alpha = rgba[4 * static_cast<std::size_t>(on_page.y * 60 + on_page.x) + 3] / 255.0;
            inked += alpha > 0.0;
            // White over grey, to the rounding of bytes.
            const double wanted = alpha + (1.0 - alpha) * at(before, x, y).x;
            ASSERT_NEAR(at(after, x, y).x, wanted, 1.01 / 255.0) << x << "," << y;
        }
    EXPECT_GT(inked, 50);
}

TEST_F(WrittenOver, IsCutWhereThePictureEnds) {
    const PageBox all{.high_px = {50.0, 50.0}, .colour = glm::dvec3(1.0)};
    Text text(gpu, picture);
    for (const glm::ivec2 corner : {glm::ivec2(-30, -20), {100, 60}, {500, 0}, {0, -500}}) {
        fill(0.0);
        text.draw({.corner_px = corner, .size_px = {50, 50}, .boxes = {all}});
        const auto pixels = rows_from_top();
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const glm::ivec2 p = glm::ivec2(x, y) - corner;
                const bool in = p.x >= 0 && p.y >= 0 && p.x < 50 && p.y < 50;
                ASSERT_EQ(at(pixels, x, y).x, in ? 1.0 : 0.0) << x << "," << y;
            }
    }
}

TEST_F(WrittenOver, APanelMakesWordsReadableOnAnyPicture) {
    Text text(gpu, picture);
    for (double grey = 0.0; grey <= 1.0; grey += 0.125) {
        fill(grey);
        // The words are blocks, all of whose pixels have the words' colour.
        const TextLine word{.text = "██", .at_px = {30.0, 45.0}, .size_px = 30.0, .colour = glm::dvec3(0.7)};
        text.draw(
            {.size_px = {kWidth, kHeight}, .boxes = {panel({0.0, 0.0}, {kWidth, kHeight})}, .lines = {word}});
        const auto pixels = rows_from_top();
        EXPECT_GT(contrast(at(pixels, 45, 40), at(pixels, 10, 40)), 4.5) << "on grey " << grey;
    }
}

TEST_F(WrittenOver, IsDrawnOnceHoweverManyWordsAndComposedOnlyWhenTheyChange) {
    fill(0.0);
    Text text(gpu, picture);
    Page page{.size_px = {kWidth, kHeight}};
    for (int i = 0; i < 12; ++i)
        page.lines.push_back({.text = "many words of text", .at_px = {2.0, 6.0 * i}, .size_px = 6.0});
    text.draw(page);
    const std::size_t textures = gpu.textures().made();
    std::vector<PassRecord> records;
    gpu.record(&records);
    text.draw(page);
    gpu.record(nullptr);
    ASSERT_EQ(records.size(), 1u);
    EXPECT_EQ(records[0].stage + ": " + records[0].pass, "text: text");
    EXPECT_EQ(records[0].draws, 1);
    EXPECT_EQ(records[0].texels, kWidth * kHeight);

    fill(0.0);
    page.lines.assign(1, {.text = "other words", .at_px = {2.0, 20.0}});
    text.draw(page);
    const auto changed = rows_from_top();
    fill(0.0);
    Text(gpu, picture).draw(page);
    EXPECT_EQ(changed, rows_from_top());
    EXPECT_LE(gpu.textures().made(), textures + 2);  // of the second Text, and of the copy read back
}

TEST_F(WrittenOver, CostsNothingWhenThereIsNothingToSay) {
    Text text(gpu, picture);
    const std::size_t textures = gpu.textures().made();
    std::vector<PassRecord> records;
    std::vector<std::string> stages;
    gpu.watch_stages([&](std::string_view stage, bool) { stages.emplace_back(stage); });
    gpu.record(&records);
    text.draw({});
    text.draw({.size_px = {50, 50}});
    gpu.record(nullptr);
    gpu.watch_stages({});
    EXPECT_TRUE(records.empty());
    EXPECT_TRUE(stages.empty());
    EXPECT_EQ(gpu.textures().made(), textures);
}

TEST_F(WrittenOver, LeavesTheNextPassUnblended) {
    fill(0.25);
    Text(gpu, picture).draw({.size_px = {10, 10}, .boxes = {{.high_px = {10.0, 10.0}, .opacity = 0.5}}});
    const FluidSetup setup = tank(false, false);
    const RenderSetup render{.width_px = 60, .height_px = 40};
    const Picture once = take_picture(gpu, setup, render, kNone, {});
    const StillSmoke still(gpu, setup, kNone);
    Renderer renderer(gpu, setup, render);
    Text over(gpu, renderer.picture());
    const Page page{.size_px = {60, 40}, .boxes = {{.high_px = {60.0, 40.0}, .colour = glm::dvec3(1.0)}}};
    renderer.draw(still, {});
    over.draw(page);
    EXPECT_EQ(renderer.rgb(), std::vector<std::uint8_t>(3 * 60 * 40, 255));
    renderer.draw(still, {});
    EXPECT_EQ(renderer.rgb(), once.rgb);
}

}  // namespace
}  // namespace eddy::gles
