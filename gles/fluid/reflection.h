#pragma once
#include "gles/field.h"
#include "gles/fluid/setup.h"
#include "gles/pass.h"

namespace eddy::gles {

/// Of a step.
enum class Part { Whole, FirstHalf, SecondHalf };

/// Second order in time: advection-reflection, Zehnder, Narain, Thomaszewski 2018, ACM Trans. Graph. 37, 85.
///
/// A step is cut in two. The first half ends with a projection, u = u* - grad phi_1, and the second starts from
/// 2 u - u* = u* - 2 grad phi_1, as if the pressure had worked twice as long: which is what it should do in a whole step.
/// What the second projection adds, phi_2, is what has changed meanwhile. So the pressure of the step is
/// 2 phi_1 + phi_2, and the bodies' loads are the same sum of what each phi does where the bodies are then.
class Reflection {
  public:
    Reflection(Gpu& gpu, const FluidSetup& setup);

    /// 2 u - u*
    Field<Faces> mirror(const Field<Faces>& u, const Field<Faces>& u_star);
    Field<Cells4> add(const Field<Cells4>& first, const Field<Cells4>& second);
    /// Where the loads of a half go, a row as Results has it; add_loads() puts their sum into `row`.
    const Texture& loads(Part half) const { return half == Part::FirstHalf ? *first_loads_ : *second_loads_; }
    void add_loads(const Texture& row);

  private:
    Gpu* gpu_;
    int bodies_;
    TexturePool::Lease first_loads_, second_loads_;
    Pass mirror_, add_, add_loads_;
};

/// Where bodies are half a step before they are where they are given.
std::vector<BodyState> half_a_step_before(std::vector<BodyState> bodies, double dt_s);

}  // namespace eddy::gles
