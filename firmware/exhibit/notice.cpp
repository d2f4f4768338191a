#include "firmware/exhibit/notice.h"

#include <algorithm>
#include <cmath>

#include "firmware/exhibit/wrapped.h"
#include "gles/render/fill.h"

namespace eddy {
namespace {

// Lengths in ems, the size of the words.
constexpr double kEmsOfHeight = 16.0, kEmsOfWidth = 28.0;  // the picture
constexpr double kMargin = 2.0;
constexpr double kLine = 1.35;
constexpr double kTitle = 1.5;                  // its size
constexpr glm::dvec2 kMovesSize{1.0, 0.3};      // in the lower margin's corner when it sets off,
constexpr double kBarAbove = 0.7, kBar = 0.15;  // and the bar above its path
constexpr Seconds kRound{4.0};                  // of what moves, there and back

const glm::dvec3 kWord{0.80, 0.83, 0.88}, kTitleColour{1.0, 1.0, 1.0};
const glm::vec3 kGround{0.02f, 0.03f, 0.06f}, kMoves{0.36f, 0.68f, 0.95f}, kToDo{0.12f, 0.15f, 0.20f};

}  // namespace

Notice::Notice(gles::Gpu& gpu, const glm::ivec2& size_px)
    : gpu_(gpu),
      picture_(size_px, gles::Format::RGBA8, true),
      text_(gpu, picture_),
      em_px_(std::min(size_px.y / kEmsOfHeight, size_px.x / kEmsOfWidth)),
      size_em_(glm::dvec2(size_px) / em_px_) {
    gles::fill(gpu, picture_, {0, 0}, size_px, kGround);
}

void Notice::draw(const std::vector<std::string>& lines, Instant now, std::optional<double> done) {
    if (lines != written_) write(lines);
    const double wide = size_em_.x - 2.0 * kMargin, bar = kMargin + kBarAbove;
    box({kMargin, kMargin}, {wide, kBarAbove + kBar}, kGround);
    const double phase = std::abs(std::remainder(Seconds(now).count() / kRound.count(), 1.0)) * 2.0;
    box({kMargin + phase * (wide - kMovesSize.x), kMargin}, kMovesSize, kMoves);
    if (!done) return;
    box({kMargin, bar}, {wide, kBar}, kToDo);
    box({kMargin, bar}, {std::clamp(*done, 0.0, 1.0) * wide, kBar}, kMoves);
}

void Notice::write(const std::vector<std::string>& lines) {
    gles::Page page;
    page.size_px = picture_.size();
    double y = kMargin;
    for (std::size_t n = 0; n < lines.size(); ++n) {
        const double scale = n == 0 ? kTitle : 1.0;
        for (const std::string& line : wrapped(lines[n], (size_em_.x - 2.0 * kMargin) / scale)) {
            y += kLine * scale;
            page.lines.push_back({.text = line,
                                  .at_px = em_px_ * glm::dvec2(kMargin, y),
                                  .size_px = em_px_ * scale,
                                  .colour = n == 0 ? kTitleColour : kWord});
        }
        y += 0.4;
    }
    gles::fill(gpu_, picture_, {0, 0}, picture_.size(), kGround);
    text_.draw(page);
    written_ = lines;
}

/// From the lower left corner of the picture.
void Notice::box(const glm::dvec2& low_em, const glm::dvec2& size_em, const glm::vec3& colour) {
    const glm::ivec2 low(glm::round(em_px_ * low_em));
    const glm::ivec2 high(glm::round(em_px_ * (low_em + size_em)));
    gles::fill(gpu_, picture_, low, high - low, colour);
}

}  // namespace eddy
