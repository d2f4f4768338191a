#include "gles/render/page.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace eddy::gles {
namespace {

/// The nearest pixel's edge from 0 to `most`; what is no number is 0.
int edge(double px, int most) {
    return px > 0.0 ? static_cast<int>(std::lround(std::min(px, static_cast<double>(most)))) : 0;
}

/// Colour and opacity as bytes.
struct Ink {
    std::array<unsigned, 3> rgb{};
    unsigned opacity = 0;

    Ink(const glm::dvec3& colour, double alpha) : opacity(byte(alpha)) {
        for (int c = 0; c < 3; ++c) rgb[static_cast<std::size_t>(c)] = byte(colour[c]);
    }
    static unsigned byte(double share) { return static_cast<unsigned>(edge(255.0 * share, 255)); }
};

/// a b / 255, rounded.
unsigned times(unsigned a, unsigned b) {
    return (a * b + 127) / 255;
}

class Canvas {
  public:
    explicit Canvas(const glm::ivec2& size)
        : size_(size), bytes_(4 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)) {}

    /// Lays ink over one pixel, as much of it as `coverage` of 255 says.
    void lay(const glm::ivec2& at, const Ink& ink, unsigned coverage) {
        if (at.x < 0 || at.y < 0 || at.x >= size_.x || at.y >= size_.y) return;
        std::uint8_t* pixel =
            &bytes_[4 * (static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size_.x) +
                         static_cast<std::size_t>(at.x))];
        const unsigned alpha = times(ink.opacity, coverage);
        for (std::size_t c = 0; c < 3; ++c)
            pixel[c] = static_cast<std::uint8_t>(times(ink.rgb[c], alpha) + times(pixel[c], 255 - alpha));
        pixel[3] = static_cast<std::uint8_t>(alpha + times(pixel[3], 255 - alpha));
    }

    void draw(const PageBox& box) {
        const Ink ink(box.colour, box.opacity);
        for (int y = edge(box.low_px.y, size_.y); y < edge(box.high_px.y, size_.y); ++y)
            for (int x = edge(box.low_px.x, size_.x); x < edge(box.high_px.x, size_.x); ++x)
                lay({x, y}, ink, 255);
    }

    void draw(const TextLine& text, Font& font) {
        const Font::Line line = font.line(text.text, text.size_px);
        const double before = text.align == Align::Right    ? line.width
                              : text.align == Align::Centre ? 0.5 * line.width
                                                            : 0.0;
        const Ink ink(text.colour, text.opacity);
        for (const Font::Line::Glyph& glyph : line.glyphs) {
            const double x = text.at_px.x + line.px * (glyph.pen - before);
            if (!can_show(x) || !can_show(text.at_px.y)) continue;
            const int quarters = static_cast<int>(std::lround(4.0 * x));
            const int quarter = ((quarters % 4) + 4) % 4;
            const Font::Bitmap& bitmap = font.bitmap(glyph.index, line.px, quarter);
            const glm::ivec2 corner =
                glm::ivec2((quarters - quarter) / 4, std::lround(text.at_px.y)) + bitmap.low_px;
            for (int j = 0, i = 0; j < bitmap.size_px.y; ++j)
                for (int k = 0; k < bitmap.size_px.x; ++k, ++i)
                    lay(corner + glm::ivec2(k, j), ink, bitmap.coverage[static_cast<std::size_t>(i)]);
        }
    }

    std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    /// Whether a pen there can leave anything on the page: no glyph is larger than a few ems.
    bool can_show(double px) const {
        const double reach = 4.0 * Font::kLargestPx;
        return px > -reach && px < std::max(size_.x, size_.y) + reach;
    }

    glm::ivec2 size_;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace

PageBox panel(const glm::dvec2& low_px, const glm::dvec2& high_px) {
    return {.low_px = low_px, .high_px = high_px, .colour = {0.01, 0.015, 0.03}, .opacity = 0.8};
}

std::vector<std::uint8_t> compose(const Page& page, Font& font) {
    if (page.empty()) return {};
    Canvas canvas(page.size_px);
    for (const PageBox& box : page.boxes) canvas.draw(box);
    for (const TextLine& line : page.lines) canvas.draw(line, font);
    return canvas.take();
}

}  // namespace eddy::gles
