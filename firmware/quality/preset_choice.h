#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "config/scene.h"
#include "hal/clock.h"

namespace eddy {

/// Which of several presets is shown: the right and left buttons of the grip step through them, and they change by
/// themselves too if they are told to. For visitors who want to feel what accuracy is worth.
class PresetChoice {
  public:
    /// `every`: 0 for never by themselves. The first shown is the first of the list.
    PresetChoice(std::vector<SolverPreset> presets, Seconds every);

    /// Buttons as in HandleReading. The preset to be shown from now on, when it changes.
    std::optional<SolverPreset> look(Instant now, std::uint8_t buttons);

  private:
    std::vector<SolverPreset> presets_;
    Seconds every_;
    std::size_t shown_ = 0;
    std::uint8_t pressed_ = 0;
    Instant since_{0};
};

}  // namespace eddy
