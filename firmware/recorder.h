#pragma once
#include <filesystem>
#include <fstream>
#include <vector>

#include "firmware/haptic/trace.h"
#include "gles/gpu.h"

namespace eddy {

/// What `--record DIR` leaves behind: frame_0000.png ..., force.csv (every tick of the haptic loop),
/// motion.png.
class Recorder {
  public:
    /// Makes the folder. Throws std::runtime_error if that or force.csv fails.
    explicit Recorder(std::filesystem::path folder);

    void add(std::span<const TickRecord> ticks);
    /// RGBA8, first row at the bottom.
    void add(gles::Gpu& gpu, const gles::Texture& picture);
    /// Completes force.csv and plots it.
    void finish();

    bool plotted() const { return plotted_; }
    int frames() const { return frames_; }
    const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path folder_;
    std::ofstream force_;
    int frames_ = 0;
    bool plotted_ = false;
};

}  // namespace eddy
