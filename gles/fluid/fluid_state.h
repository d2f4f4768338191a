#pragma once
#include <vector>

#include "gles/field.h"
#include "gles/fluid/setup.h"

namespace eddy::gles {

class Coupling;
class Driven;
class ForceMethodsPass;

/// Where a fluid is at the end of a step, for another to go on from: references into it, which end with its next step.
/// Null: it has none. One kind of velocity and one of pressure is there, unless the flow is imposed.
struct FluidState {
    const FluidSetup& setup;
    const std::vector<BodyState>& bodies;
    long steps = 0;
    double time_s = 0.0;
    double dt_s = 0.0;  ///< of the last step; 0 before the first

    const Field<Faces>* on_faces = nullptr;     ///< velocity [m/s]
    const Field<Cells>* at_centres = nullptr;   ///< velocity [m/s]
    const Field<Cells4>* phi4 = nullptr;        ///< dt p / (rho h) [m/s]
    const Field<Cells>* phi = nullptr;          ///< the same
    const Field<Cells>* smoke = nullptr;        ///< density [1]
    const Field<Cells>* temperature = nullptr;  ///< excess [K]

    // What only the staggered grid knows.
    const Field<Faces>* diffused = nullptr;  ///< velocity before the projection, in a viscous fluid [m/s]
    const Coupling* coupling = nullptr;
    const Driven* driven = nullptr;
    const ForceMethodsPass* force_methods = nullptr;
};

}  // namespace eddy::gles
