#include "gles/render/font.h"

#include <stb/stb_truetype.h>

#include <algorithm>
#include <span>
#include <stdexcept>

#include "gles/render/utf8.h"

namespace eddy {
extern const std::span<const unsigned char> kDejaVuSans;
}

namespace eddy::gles {
namespace {

/// Bitmaps are drawn once; when they come to more than this, those not used any more must go: all do.
constexpr std::size_t kMostBytes = 8 << 20;

}  // namespace

struct Font::Outlines {
    stbtt_fontinfo info{};
};

Font::Font() : outlines_(std::make_unique<Outlines>()) {
    if (!stbtt_InitFont(&outlines_->info, kDejaVuSans.data(), 0))
        throw std::runtime_error("the typeface that was built into this program is none");
}

Font::~Font() = default;

Font::Line Font::line(std::string_view utf8, double size_px) const {
    Line line;
    if (!(size_px > 0.0)) return line;
    const stbtt_fontinfo& font = outlines_->info;
    line.px = static_cast<double>(
        stbtt_ScaleForMappingEmToPixels(&font, static_cast<float>(std::min(size_px, kLargestPx))));
    for (const char32_t point : code_points(utf8)) {
        const int index = stbtt_FindGlyphIndex(&font, static_cast<int>(point));
        if (!line.glyphs.empty())
            line.width += stbtt_GetGlyphKernAdvance(&font, line.glyphs.back().index, index);
        line.glyphs.push_back({index, line.width});
        int advance = 0, bearing = 0;
        stbtt_GetGlyphHMetrics(&font, index, &advance, &bearing);
        line.width += advance;
    }
    return line;
}

double Font::width_px(std::string_view utf8, double size_px) const {
    const Line set = line(utf8, size_px);
    return set.px * set.width;
}

const Font::Bitmap& Font::bitmap(int glyph, double px, int quarter) {
    const auto key = std::tuple(glyph, px, quarter);
    if (const auto drawn = bitmaps_.find(key); drawn != bitmaps_.end()) return drawn->second;
    if (bytes_ > kMostBytes) {
        bitmaps_.clear();
        bytes_ = 0;
    }
    const stbtt_fontinfo& font = outlines_->info;
    const float scale = static_cast<float>(px), shift = 0.25f * static_cast<float>(quarter);
    glm::ivec2 low(0), high(0);
    stbtt_GetGlyphBitmapBoxSubpixel(&font, glyph, scale, scale, shift, 0.0f, &low.x, &low.y, &high.x,
                                    &high.y);
    Bitmap& bitmap = bitmaps_[key];
    bitmap.low_px = low;
    bitmap.size_px = high - low;
    bitmap.coverage.resize(static_cast<std::size_t>(bitmap.size_px.x) *
                           static_cast<std::size_t>(bitmap.size_px.y));
    bytes_ += bitmap.coverage.size();
    if (!bitmap.coverage.empty())
        stbtt_MakeGlyphBitmapSubpixel(&font, bitmap.coverage.data(), bitmap.size_px.x, bitmap.size_px.y,
                                      bitmap.size_px.x, scale, scale, shift, 0.0f, glyph);
    return bitmap;
}

}  // namespace eddy::gles
