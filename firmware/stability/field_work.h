#pragma once
#include "firmware/stability/fields.h"

namespace eddy::stability {

/// Work done on the fluid in a step of dt_s that left these fields [J], as far as the fields tell: by gravity on every drop,
/// by the pressure at walls that fluid comes in through, and what that fluid brings along. Never less than it was: what leaves takes
/// nothing with it here. Staggered fields only.
double field_work_j(const gles::FluidSetup& setup, const Fields& fields, double dt_s);

/// The fastest that gravity alone makes the fluid where it can fall out of the tank or into it [m/s]; 0 if all walls are closed.
double falling_speed_m_s(const gles::FluidSetup& setup);

}  // namespace eddy::stability
