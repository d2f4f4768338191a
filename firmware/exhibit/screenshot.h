#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "hal/clock.h"

namespace eddy {

/// Whoever may write into the run folder and makes a file `screenshot.request` there gets the next frame as `screenshot.png`; the
/// request goes away when the picture is there. Asked each frame; looks at the folder four times a second at most.
class Screenshot {
  public:
    static constexpr Instant kEvery = std::chrono::milliseconds(250);

    /// `folder`: the run folder; empty: nobody can ask.
    explicit Screenshot(const std::filesystem::path& folder);

    bool wanted(Instant now);
    /// The frame: three bytes a pixel, first row at the top. For the log: where the picture is, or why not; the request is gone in any
    /// case.
    std::string give(int width, int height, std::span<const std::uint8_t> rgb);

  private:
    std::filesystem::path request_, picture_;
    std::optional<Instant> looked_;
};

}  // namespace eddy
