#pragma once
#include <string>
#include <vector>

#include "gles/render/text.h"
#include "hal/clock.h"

namespace eddy {

/// A screen of words where there is no fluid to show: while the exhibit starts, while it is closed, when it cannot start.
/// Something on it moves, so that everybody sees that the machine lives. GL thread only.
class Notice {
  public:
    /// Needs no shader but that of words: it can be shown before the fluid's are compiled.
    explicit Notice(gles::Gpu& gpu, const glm::ivec2& size_px = {640, 360});

    /// The first line is the title; long lines are broken.
    void draw(const std::vector<std::string>& lines, Instant now);
    /// RGBA8, first row at the bottom.
    const gles::Texture& picture() const { return picture_; }

  private:
    gles::Texture picture_;
    gles::Text text_;
};

}  // namespace eddy
