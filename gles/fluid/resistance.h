#pragma once
#include <vector>

#include "gles/fluid/setup.h"

namespace eddy::gles {

/// About how strongly friction resists a change of a body's motion within one step, over the inertia of the fluid in the
/// body's place; 0 in an inviscid fluid. `turns`: of its turning, else of its moving.
///
/// What friction is treated implicitly with. Steady motion does not depend on it, but too little is unstable for light bodies
/// in thick fluids, and too much makes them sluggish. It is one and a half times that of a ball of the body's volume: Stokes'
/// 6 pi mu a and 8 pi mu a^3; the layer that starts to move within the step (Basset); and, moving, what is squeezed out
/// before the nearest wall or body (a / gap times Stokes: Cox, Brenner 1967, Chem. Eng. Sci. 22). With half of it a ball of 1 %
/// of the fluid's density became unstable in fluids so thick that a step is longer than all it takes to set them moving.
double resistance_1_s(const FluidSetup& setup, const std::vector<BodyState>& states, std::size_t body,
                      bool turns, double dt_s);

}  // namespace eddy::gles
