#pragma once
#include <optional>
#include <string>
#include <vector>

#include "config/scene.h"
#include "firmware/force_ripple.h"
#include "firmware/show.h"
#include "firmware/stopwatch.h"
#include "hal/clock.h"

namespace eddy {

/// What the accuracy of a running fluid costs, and what one gets for it: for the page (cost_page.h) and status.json.
struct CostFigures {
    std::string preset{};
    glm::ivec3 cells{0};
    std::string iterations{};             ///< of the pressure in a step: "2 cycles", "40 sweeps"
    double steps_per_s = 0.0;             ///< of the machine's clock, also where the run's is stepped
    double target_steps_per_s = 0.0;      ///< that of solver.dt_s
    std::optional<double> force_error{};  ///< share of the force; none: never measured here
    double divergence_before_1_s = 0.0, divergence_after_1_s = 0.0;  ///< largest |div u|, of the projection
    struct Stage {
        std::string name;
        double ms = 0.0;
    };
    std::vector<Stage>
        stages{};  ///< of a step, in the order they run; wall time, the GPU drained before and after each
    double step_ms = 0.0;     ///< their sum
    double picture_ms = 0.0;  ///< the same of drawing one picture; 0: none was drawn
    std::optional<ForceRipple::Figures>
        ripple{};                          ///< [N], of the force on the hand after gain; none: not known yet
    int quality_down = 0, quality_up = 0;  ///< steps taken since the start
    std::string quality_note{};  ///< why the last was taken, or what else there is to say of the quality
};

/// Steps a second by the machine's clock, as they were lately.
class StepRate {
  public:
    void add_step();
    double per_s() const { return period_s_ > 0.0 ? 1.0 / period_s_ : 0.0; }

  private:
    RealClock clock_;
    std::optional<Seconds> last_;
    double period_s_ = 0.0;
};

/// The figures as they are now; times are medians of the last measurements.
CostFigures cost_figures(const Scene& scene, const Show& show, const Stopwatch& stopwatch,
                         const StepRate& rate);

}  // namespace eddy
