#pragma once
#include <glm/glm.hpp>
#include <optional>

#include "hal/clock.h"
#include "hal/haptic/haptic_device.h"

namespace eddy::falcon {

/// Finds what a motor unit is worth with a known weight. Nobody may touch the handle: the motors themselves hold it
/// in the middle of the workspace, first empty, then with the weight hanging from it, and move it slowly up and down.
/// What they need more with the weight is the weight, if the scale is right; friction, which helps on the way up as
/// much as it hinders on the way down, drops out of the mean over whole swings. Pure: no clock, no device.
class Calibration {
  public:
    enum class Stage {
        Empty,   ///< measures the handle alone
        HangOn,  ///< holds still until weight_hangs()
        Loaded,  ///< measures with the weight
        Done,
        Failed,
    };

    /// `motor_units_per_nm`: what the driver is set to meanwhile; `least`, `most`: between which it is believed.
    Calibration(double weight_kg, double motor_units_per_nm, double least, double most);

    /// One tick: the force to command [N, Device], zero when it has ended. `reading`: the newest one; the handle must
    /// be Ready.
    glm::dvec3 tick(Instant now, const std::optional<HandleReading>& reading);
    /// The person has hung the weight on.
    void weight_hangs();

    Stage stage() const { return stage_; }
    /// When Done: motor units for a newton metre at the arm.
    double motor_units_per_nm() const { return found_; }
    /// When Done: how far the two halves of the measurement with the weight are apart, as a share of the weight.
    double spread() const { return spread_; }
    /// When Failed: why, and what to do.
    const char* problem() const { return problem_; }

  private:
    void begin(Stage stage, Instant now);
    void fail(const char* problem);
    void finish();
    void follow(const HandleReading& reading);
    double lift_at(Seconds in_stage) const;
    void measure(Seconds in_stage, double force_y_n);

    const double weight_n_;
    const double used_, least_, most_;  // motor units for a newton metre
    Stage stage_ = Stage::Empty;
    bool started_ = false;
    bool weight_hangs_ = false;
    Instant stage_began_{0};
    const char* problem_ = "";

    std::optional<HandleReading> last_;
    glm::dvec3 start_m_{0.0};
    glm::dvec3 velocity_m_s_{0.0};  // low-passed
    glm::dvec3 steady_n_{0.0};      // what the spring has learnt to give of itself
    Instant ticked_at_{0};

    struct Mean {
        double sum = 0.0;
        long count = 0;
        void add(double value) { sum += value, ++count; }
        double value() const { return count > 0 ? sum / static_cast<double>(count) : 0.0; }
    };
    Mean empty_, first_half_, second_half_;
    double found_ = 0.0;
    double spread_ = 0.0;
};

}  // namespace eddy::falcon
