#pragma once
#include <fmt/format.h>

#include "gles/fluid/fluid.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {

/// A tank in units of cells (h = 1 m, rho = 1 kg/m3) with one sphere, or none.
inline FluidSetup unit_tank(const glm::ivec3& cells, double radius, Advection advection, int cycles) {
    FluidSetup s;
    s.cells = cells;
    s.cell_m = 1.0;
    s.density_kg_m3 = 1.0;
    s.solver.advection = advection;
    s.solver.cycles = cycles;
    if (radius > 0.0) s.bodies = {BodySetup{Sphere{radius}}};
    return s;
}

/// Keeps a measured number with the test's result (ctest --output-junit, --gtest_output=xml).
inline void record(const char* name, double value) {
    testing::Test::RecordProperty(name, fmt::format("{:.6g}", value));
}

}  // namespace eddy::gles
