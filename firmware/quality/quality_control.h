#pragma once
#include <filesystem>
#include <map>
#include <memory>

#include "firmware/quality/governor.h"
#include "firmware/quality/preset_choice.h"
#include "firmware/quality/tuner.h"

namespace eddy {

/// Decides with which quality the fluid of a running show is computed. One of three: presets that the visitor steps through; the
/// ladder that this machine was tuned to, with a governor that keeps the rate; the scene as it is written.
class QualityControl {
  public:
    struct Setup {
        std::vector<SolverPreset> presets{};  ///< more than one: for the visitor to choose from
        Seconds preset_every{0.0};            ///< they also change by themselves; 0: never
        std::filesystem::path tuning{};       ///< file it is kept in; empty: neither read nor written
    };
    QualityControl(gles::Gpu& gpu, const Scene& scene, Setup setup);

    /// Every quality that update() may ask for, to be made ready before; neighbours follow each other most often.
    std::vector<Quality> all() const;
    /// The one to begin with.
    Quality first() const;

    /// The quality to go on with, and why, for the log.
    struct Change {
        Quality quality;
        std::string reason;
    };
    /// From one update of the fluid to the next.
    struct Interval {
        Seconds length{0.0};
        Seconds elsewhere{0.0};  ///< of it, into pictures or work(): no other quality would help against that
        long steps = 1;          ///< taken in it, several where a delay is made up for
    };
    /// After each update. The change, if there is one.
    std::optional<Change> update(Instant now, const Interval& since_last, std::uint8_t buttons);
    /// Now and then: how long a step kept the machine busy.
    void step_took(double busy_ms);

    /// A piece of what can wait for a moment without visitors: tuning the machine if it was not, or measuring how exact each
    /// preset is. Returns what there is to say about it, in a line.
    std::optional<std::string> work();

    /// Share of the force, if this quality was measured here.
    std::optional<double> force_error(const Quality& quality) const;
    int steps_down() const;
    int steps_up() const;
    /// Why the last step was taken, or what else there is to say. Empty: nothing.
    std::string note() const;

  private:
    Quality in_preset(SolverPreset preset) const;
    void adopt(const Tuning& tuning);
    std::optional<std::string> tune();
    std::optional<std::string> measure_presets();

    gles::Gpu& gpu_;
    Scene scene_;
    Setup setup_;
    PresetChoice presets_;
    std::vector<Rung> ladder_;
    std::optional<Governor> governor_;
    std::unique_ptr<Tuner> tuner_;
    bool gave_up_ = false;            ///< tuning or measuring failed, and would again
    std::optional<Quality> adopted_;  ///< to be shown from the next update on
    std::string trouble_;             ///< why there is no tuning
    std::unique_ptr<ForceError> measuring_;
    std::map<Quality, double> errors_;  ///< of presets, as far as they were measured
};

}  // namespace eddy
