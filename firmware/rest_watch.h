#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "config/scene.h"
#include "hal/clock.h"

namespace eddy {

/// Whether something will move though nothing does now, or moves that the fluid as a whole hardly shows: such a show never rests.
bool moves_by_itself(const Scene& scene);

/// Tells when nobody is here, and when the show may rest: for some time nobody has moved the hand and, for resting, the fluid
/// has been still. A hand that moves, comes or goes ends both at once.
class RestWatch {
  public:
    /// It takes this long.
    static constexpr Seconds kQuietFor{5.0};
    /// Less than this is no movement of the handle: what encoders and a resting arm do.
    static constexpr double kStill_m = 0.5e-3;
    /// A fluid that takes longer than this to cross the tank is still.
    static constexpr Seconds kStillCrossing{100.0};

    /// `tank_m`: its longest side; `scale`: how far a hand goes in it when the handle goes 1.
    explicit RestWatch(double tank_m, double scale = 1.0)
        : still_m_s_(tank_m / kStillCrossing.count()), still_m_(scale * kStill_m) {}

    /// Before each update: where the hand is, if anywhere, and its buttons.
    void see(Instant now, const std::optional<glm::dvec3>& hand_m, std::uint8_t buttons);
    /// When it was measured: the greatest speed, root mean square of the fluid. Nothing known yet counts as
    /// moving.
    void all_moves_at(double speed_m_s) { still_ = speed_m_s <= still_m_s_; }

    /// Since somebody moved the handle or pressed one of its buttons; a device that comes or goes is not somebody.
    Instant untouched() const { return now_ - touched_; }

    bool nobody_here() const { return now_ - hand_moved_ >= kQuietFor; }
    bool may_rest() const { return nobody_here() && now_ - fluid_moved_ >= kQuietFor; }

  private:
    double still_m_s_, still_m_;
    bool still_ = false;
    std::optional<glm::dvec3> at_;
    std::uint8_t buttons_ = 0;
    bool began_ = false;
    Instant now_{0}, hand_moved_{0}, touched_{0}, fluid_moved_{0};
};

}  // namespace eddy
