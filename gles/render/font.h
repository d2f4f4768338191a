#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string_view>
#include <tuple>
#include <vector>

namespace eddy::gles {

/// DejaVu Sans, which is compiled into the binary. Sizes are those of its em square; a capital is 0.73 of that high, a
/// digit 0.64 wide, and all digits are as wide.
class Font {
  public:
    Font();
    ~Font();
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    /// Where the glyphs of a line stand, in units of the font, of which `px` pixels are one: exact, so that what is to
    /// end at the same column does.
    struct Line {
        struct Glyph {
            int index;  ///< 0: the box of what the font has no glyph for
            int pen;    ///< from the line's start
        };
        std::vector<Glyph> glyphs;
        int width = 0;
        double px = 0.0;
    };
    /// Nothing for a size that is no number or not positive; sizes beyond kLargestPx are that.
    Line line(std::string_view utf8, double size_px) const;
    double width_px(std::string_view utf8, double size_px) const;

    struct Bitmap {
        glm::ivec2 low_px{0};  ///< upper left corner from the pen on the baseline, y down
        glm::ivec2 size_px{0};
        std::vector<std::uint8_t> coverage;  ///< 0 .. 255, row by row from the top
    };
    /// A glyph at `px` pixels a unit whose pen stands `quarter` (0 .. 3) quarters of a pixel right of a pixel's edge. Holds
    /// until the next call.
    const Bitmap& bitmap(int glyph, double px, int quarter);

    static constexpr double kLargestPx = 400.0;

  private:
    struct Outlines;
    std::unique_ptr<Outlines> outlines_;
    std::map<std::tuple<int, double, int>, Bitmap> bitmaps_;  // drawn so far
    std::size_t bytes_ = 0;                                   // of these
};

}  // namespace eddy::gles
