#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gles/render/font.h"

namespace eddy::gles {

// What is written over the picture: boxes, and lines of text on them. Lengths in pixels, from the upper left corner, y
// down. Colours are display values, 0 .. 1, as in the finished picture.

enum class Align { Left, Right, Centre };

/// One line of text; what reaches past the page is cut.
struct TextLine {
    std::string text{};     ///< UTF-8, whatever the bytes
    glm::dvec2 at_px{0.0};  ///< on the baseline: where the line begins, ends or has its middle
    double size_px = 16.0;  ///< of the em square, see Font
    Align align = Align::Left;
    glm::dvec3 colour{1.0};
    double opacity = 1.0;
    bool operator==(const TextLine&) const = default;
};

/// A filled rectangle, its edges at the nearest pixels.
struct PageBox {
    glm::dvec2 low_px{0.0}, high_px{0.0};
    glm::dvec3 colour{0.0};
    double opacity = 1.0;
    bool operator==(const PageBox&) const = default;
};

/// A box for light words to stand on: those of 0.7 and more have a contrast of at least 5.7 to it even on a white
/// picture, of which it lets through a fifth. WCAG 2.2 (1.4.3) wants 4.5.
PageBox panel(const glm::dvec2& low_px, const glm::dvec2& high_px);

struct Page {
    glm::ivec2 corner_px{0};  ///< its upper left, in the picture
    glm::ivec2 size_px{0};
    std::vector<PageBox> boxes{};   ///< each over those before it
    std::vector<TextLine> lines{};  ///< over all boxes
    bool empty() const { return (boxes.empty() && lines.empty()) || size_px.x <= 0 || size_px.y <= 0; }
    bool operator==(const Page&) const = default;
};

/// The page as pixels: RGBA, four bytes each, first row at the top; colours hold their alpha already.
std::vector<std::uint8_t> compose(const Page& page, Font& font);

}  // namespace eddy::gles
