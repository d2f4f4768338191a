#pragma once
#include <optional>
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

    /// The first line is the title; long lines are broken. `done`, if known, is the share of what is waited for, as a bar. Cheap as
    /// long as the lines are the same.
    void draw(const std::vector<std::string>& lines, Instant now, std::optional<double> done = {});
    /// RGBA8, first row at the bottom.
    const gles::Texture& picture() const { return picture_; }

  private:
    void write(const std::vector<std::string>& lines);
    void box(const glm::dvec2& low_em, const glm::dvec2& size_em, const glm::vec3& colour);

    gles::Gpu& gpu_;
    gles::Texture picture_;
    gles::Text text_;
    double em_px_;
    glm::dvec2 size_em_;
    std::optional<std::vector<std::string>> written_;
};

}  // namespace eddy
