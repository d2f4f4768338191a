#pragma once
#include <string>

#include "gles/fluid/setup.h"
#include "gles/pass.h"

namespace eddy::gles {

/// GLSL that declares x, y, z [m] and t [s] for a formula, from a place `cells` and a uniform `time`.
std::string formula_variables(double cell_m, const char* time);
/// GLSL: vec3 where_finite(vec3 v), v with 0 for what a formula has no value for, as sqrt(-1). By the bits, as in guard.glsl.
extern const char* const kWhereFinite;

/// The tank's walls as the shaders see them. A tank whose walls are all slip walls adds nothing to any shader.
///
/// Declares, where asked for, with walls numbered x low 0, x high 1, ... z high 5 and x in cells:
///   vec3 wall_velocity(int wall, vec3 x)     of the wall at the point of it nearest x [m/s]; 0 where it has none
///   const vec3 FRICTION_LOW, FRICTION_HIGH   weight of the wall in the viscous term of the cell beside it, axis
///                                            by axis: 2 (the wall is half a cell away) or 0
///   const vec3 OPEN_LOW, OPEN_HIGH           weight of the outside in the pressure equation: 2 or 0
///   const vec3 INFLOW_LOW, INFLOW_HIGH       1 or 0
class Walls {
  public:
    explicit Walls(const FluidSetup& setup) : setup_(&setup) {}

    /// Whether any wall is an inflow or open: shaders know that as switch THROUGH.
    bool let_through() const;
    /// Whether the fluid sticks to any wall (no-slip, inflow): switch FRICTION.
    bool rub() const;
    /// Adds the switches and declarations to a variant. `covered`: how much of the last cell of each axis lies in
    /// the tank, less than 1 on coarse grids of an odd number of cells.
    void declare(Variant& variant, const glm::vec3& covered = glm::vec3(1.0f)) const;
    /// What wall_velocity() needs to know.
    Uniform time(double time_s) const { return {"wall_time", static_cast<float>(time_s)}; }

  private:
    const FluidSetup* setup_;
};

}  // namespace eddy::gles
