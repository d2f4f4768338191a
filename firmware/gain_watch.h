#pragma once
#include <optional>
#include <string>

#include "firmware/gain_limit.h"

namespace eddy {

/// The gain a scene gets: its own, or as much of it as the loop stands at the rate at which the fluid really answers.
class GainWatch {
  public:
    GainWatch(double scene_gain, double workspace_scale) : scene_gain_(scene_gain), scale_(workspace_scale) {}

    /// What the fluid of the scene does to its body.
    void learn(const FluidSlopes& slopes) { slopes_ = slopes; }
    /// With the measured time between answers, and from a pose to the answer to it. Whether the gain is another now: it
    /// follows in steps of a tenth, each of which the hand hardly feels.
    bool see(Seconds fluid_period, Seconds lateness = Seconds(0.0));

    double gain() const { return gain_.value_or(scene_gain_); }
    long changes() const { return changes_; }  ///< since the first
    /// A sentence for the log, once: the first time it is held down.
    std::optional<std::string> news();

  private:
    double scene_gain_, scale_;
    FluidSlopes slopes_{};
    Seconds period_{0.0}, lateness_{0.0};
    std::optional<double> gain_;
    long changes_ = 0;
    bool told_ = false;
};

}  // namespace eddy
