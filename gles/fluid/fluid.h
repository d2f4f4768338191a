#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "gles/field.h"
#include "gles/fluid/fluid_state.h"
#include "gles/fluid/setup.h"
#include "gles/fluid/step_guard.h"

namespace eddy::gles {

/// What a step did to the whole tank; costs a pass over the grid, so it is made only when asked for.
struct Diagnostics {
    double divergence_before_1_s = 0.0;  ///< max |div u| before the projection, the bodies' motion included
    double divergence_max_1_s = 0.0;     ///< the same after it
    double kinetic_energy_j =
        0.0;                   ///< rho/2 sum |u|^2 h^3 (solid regions move with their body and are included)
    double smoke_total = 0.0;  ///< sum of the smoke density over all cells times the cell volume [m^3]
    double temperature_total = 0.0;  ///< the same of the temperature [K m^3]
};

/// What a step found in the fluid as the last one left it.
struct Health {
    long velocity_texels = 0;  ///< that cannot be: not finite, or beyond what Sound says
    long pressure_texels = 0;
    long scalar_texels = 0;    ///< of smoke and heat
    double fastest_m_s = 0.0;  ///< of the fluid, where it is sound

    long texels() const { return velocity_texels + pressure_texels + scalar_texels; }
};

struct StepResult {
    long step = 0;              ///< number of the step, from 1
    std::vector<Load> loads{};  ///< one for each body; zero where nothing is measured
    std::optional<Diagnostics> diagnostics{};
    Health health{};

    /// Whether its loads are those of a flow.
    bool is_sound() const;
};

/// A fluid in its tank. The GL thread calls everything.
class Fluid {
  public:
    virtual ~Fluid() = default;
    /// Moves on by dt_s, ending with the bodies as given; what the fluid decides of a coupled body is taken from there
    /// only to start with. Returns at once and the GPU works on, unless a body is coupled. Whatever is given, the guards
    /// (step_guard.h) make a step of it that can be computed. A length that is none leaves all as it is: steps() does not
    /// count it, and its answer is the last one again.
    void step(double dt_s, const std::vector<BodyState>& bodies, bool diagnose);
    /// The oldest result not yet taken. Without `wait`: only if the GPU has finished it.
    std::optional<StepResult> result(bool wait);
    /// The oldest result, waiting for the GPU as long as it takes. Throws GlError if the GPU has stopped answering.
    StepResult wait_result();
    /// Steps asked for since the start.
    virtual long steps() const = 0;
    /// All bodies after the last step.
    const std::vector<BodyState>& bodies() const { return bodies_; }
    /// Back to the start, exactly; but guards() counts on.
    void reset();
    const GuardCounts& guards() const { return guards_; }
    /// Goes on from where `from` is: its time, number of steps, bodies, flow, smoke and heat, brought over on the GPU. The two
    /// must have the same tank and bodies, and both or neither an imposed flow (else std::logic_error); cells, method and all
    /// other settings may differ. From a fluid with the same cells and kind of grid everything is copied bit for bit. From
    /// any other it is interpolated, and freed of divergence there and then, so that the force of the next step is the
    /// force of that step. What `from` does not have starts as after reset(); results not yet taken are dropped.
    void take_over(const Fluid& from);

    /// Smoke density at cell centres; null if the scene has none.
    virtual const Field<Cells>* smoke() const = 0;
    /// Temperature above the reference [K] at cell centres; null if the scene has none.
    virtual const Field<Cells>* temperature() const { return nullptr; }
    /// Velocity [m/s] as a plain array, x fastest, then y, then z. Waits for the GPU.
    /// On the staggered grid: (nx+1)(ny+1)(nz+1) entries, component c on the lower face of its cell.
    virtual std::vector<glm::vec3> velocity() const = 0;
    /// Pressure [Pa] in each cell, for the last step; x fastest. Waits for the GPU.
    virtual std::vector<float> pressure() const = 0;
    /// Forces by other ways, of the last step, one for each body; empty without setup().force_methods.
    virtual std::vector<ForceMethods> force_methods() const { return {}; }
    /// Replaces the velocity field (same order as velocity()); it need not be free of divergence.
    virtual void set_velocity(const std::vector<glm::vec3>& u) = 0;

    const FluidSetup& setup() const { return setup_; }

  protected:
    explicit Fluid(FluidSetup setup) : setup_(std::move(setup)) {}
    /// A step of the solver's own, of whatever a step may be given.
    virtual void move_on(double dt_s, const std::vector<BodyState>& bodies, bool diagnose) = 0;
    virtual std::optional<StepResult> take_result(bool wait) = 0;
    virtual void start_over() = 0;
    /// What it is now, and how it becomes what another is.
    virtual FluidState state() const = 0;
    virtual void resume(const FluidState& from) = 0;

    const FluidSetup setup_;
    std::vector<BodyState> bodies_;  ///< at the end of the last step; none before the first

  private:
    void forget_answers();

    GuardCounts guards_;
    std::optional<StepResult> last_;  ///< given out
    long taken_ = 0;                  ///< the step of the last answer taken, or where it went on from
    long again_ = 0;                  ///< answers that are to be the last one again
};

/// The solver that setup.solver.method names, or none if the flow is imposed.
std::unique_ptr<Fluid> make_fluid(Gpu& gpu, const FluidSetup& setup);

}  // namespace eddy::gles
