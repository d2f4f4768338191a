#include "firmware/exhibit/notice.h"

#include <algorithm>
#include <cmath>

#include "firmware/exhibit/wrapped.h"

namespace eddy {
namespace {

// Lengths in ems, the size of the words.
constexpr double kEmsOfHeight = 16.0, kEmsOfWidth = 28.0;  // the picture
constexpr double kMargin = 2.0;
constexpr double kLine = 1.35;
constexpr double kTitle = 1.5;  // its size
constexpr Seconds kRound{4.0};  // of what moves, there and back

const glm::dvec3 kGround{0.02, 0.03, 0.06}, kWord{0.80, 0.83, 0.88}, kTitleColour{1.0, 1.0, 1.0},
    kMoves{0.36, 0.68, 0.95};

}  // namespace

Notice::Notice(gles::Gpu& gpu, const glm::ivec2& size_px)
    : picture_(size_px, gles::Format::RGBA8, true), text_(gpu, picture_) {
    const std::vector<std::uint8_t> black(4 * static_cast<std::size_t>(size_px.x * size_px.y), 0);
    picture_.upload(black.data());
}

void Notice::draw(const std::vector<std::string>& lines, Instant now) {
    const glm::dvec2 size(picture_.size());
    const double em_px = std::min(size.y / kEmsOfHeight, size.x / kEmsOfWidth);
    gles::Page page;
    page.size_px = picture_.size();
    page.boxes.push_back({.low_px = glm::dvec2(0.0), .high_px = size, .colour = kGround});
    const double wide = size.x / em_px - 2.0 * kMargin;
    double y = kMargin;
    for (std::size_t n = 0; n < lines.size(); ++n) {
        const double scale = n == 0 ? kTitle : 1.0;
        for (const std::string& line : wrapped(lines[n], wide / scale)) {
            y += kLine * scale;
            page.lines.push_back({.text = line,
                                  .at_px = em_px * glm::dvec2(kMargin, y),
                                  .size_px = em_px * scale,
                                  .colour = n == 0 ? kTitleColour : kWord});
        }
        y += 0.4;
    }
    const double phase = std::abs(std::remainder(Seconds(now).count() / kRound.count(), 1.0)) * 2.0;
    const double x = kMargin + phase * (wide - 1.0);
    const double floor = size.y / em_px - kMargin;
    page.boxes.push_back({.low_px = em_px * glm::dvec2(x, floor - 0.3),
                          .high_px = em_px * glm::dvec2(x + 1.0, floor),
                          .colour = kMoves});
    text_.draw(page);
}

}  // namespace eddy
