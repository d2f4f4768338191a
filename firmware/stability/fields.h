#pragma once
#include <vector>

#include "gles/fluid/fluid.h"

namespace eddy::stability {

/// The tank whose fields are judged.
struct Tank {
    glm::ivec3 cells{8};
    double cell_m = 0.01;
    double density_kg_m3 = 1.2;
    double viscosity_pa_s = 0.0;
    bool staggered = true;  ///< velocities on faces, one layer more each way; else at the centres of cells

    double longest_m() const { return cell_m * std::max({cells.x, cells.y, cells.z}); }
    double mass_kg() const { return density_kg_m3 * cell_m * cell_m * cell_m * cells.x * cells.y * cells.z; }
};
Tank tank_of(const gles::FluidSetup& setup);

/// What a step left in the tank, on the processor, x fastest, then y, then z. Empty: the scene has none.
struct Fields {
    std::vector<glm::vec3> velocity_m_s = {};  ///< as Fluid::velocity()
    std::vector<float> pressure_pa = {};
    std::vector<float> smoke = {};
    std::vector<float> temperature_k = {};
};
/// Waits for the GPU.
Fields download(const gles::Fluid& fluid);

/// Texels with a number that is none, or infinite; the layers beyond the upper walls are texels too.
long non_finite_texels(const Fields& fields);

/// The longest velocity. A component on a face that is not in the tank has no meaning and does not count.
double largest_speed_m_s(const Tank& tank, const Fields& fields);

/// rho/2 sum |u|^2 h^3, solids included; faces on walls stand for half a cell.
double kinetic_energy_j(const Tank& tank, const Fields& fields);

struct FieldRange {
    double low = 0.0, high = 0.0;
};
/// 0 and 0 if there are no values.
FieldRange range_of(const std::vector<float>& values);

}  // namespace eddy::stability
