#pragma once
#include <memory>

#include "firmware/haptic/exchange.h"
#include "firmware/stability/case.h"

namespace eddy::stability {

/// What moves the fluid of a trial on.
class Rig {
  public:
    virtual ~Rig() = default;
    /// A step as the moment says. `hand`: where the hand is, at `now`.
    virtual void step(const Moment& moment, const PoseSnapshot& hand, Instant now) = 0;
    /// Loads of that step, as they came back; one for each body, or the held body's alone. Empty where none came.
    virtual std::vector<gles::Load> loads() = 0;
    /// The same by other ways, where the scene asks for them; else empty.
    std::vector<gles::ForceMethods> force_methods() const { return fluid().force_methods(); }
    /// What the hand may know.
    virtual FluidSnapshot answer() = 0;
    virtual const gles::Fluid& fluid() const = 0;
    /// Of all fluids that there were.
    virtual gles::GuardCounts guards() const = 0;
    virtual void reset() = 0;
    virtual void change_preset() {}
};

/// How much time the fluid lets pass in a step that is asked to last dt_s: none in one that it refuses.
double taken_s(const gles::FluidSetup& setup, double dt_s);

/// `setup`: of the scene; with a hand, the exhibit makes its own. `bodies`: see Case::bodies; of all cases that are tried at
/// once. stop_s: when the scene's own bodies run down.
using ChangeBodies = std::function<void(const Moment&, std::vector<gles::BodyState>&)>;
std::unique_ptr<Rig> make_rig(gles::Gpu& gpu, const Scene& scene, const gles::FluidSetup& setup,
                              bool with_hand, ChangeBodies bodies, double stop_s);

}  // namespace eddy::stability
