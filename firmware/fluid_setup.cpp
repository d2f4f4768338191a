#include "firmware/fluid_setup.h"

namespace eddy {
namespace {

gles::SolverSetup solver_setup(const Scene::Solver& solver) {
    gles::SolverSetup s;
    switch (solver.preset) {
        case SolverPreset::Fast:
            s.cycles = 2;
            break;
        case SolverPreset::Precise:
            s.advection = gles::Advection::MacCormack;
            s.cycles = 3;
            break;
        case SolverPreset::Yang2009:
            s.method = gles::Method::Yang2009;
            break;
    }
    if (solver.advection)
        s.advection = *solver.advection == AdvectionScheme::MacCormack ? gles::Advection::MacCormack
                                                                       : gles::Advection::SemiLagrangian;
    if (solver.cycles) s.cycles = *solver.cycles;
    if (solver.jacobi_sweeps) s.jacobi_sweeps = *solver.jacobi_sweeps;
    return s;
}

}  // namespace

gles::FluidSetup fluid_setup(const Scene& scene) {
    gles::FluidSetup s;
    s.cells = scene.tank.cells;
    s.cell_m = scene.tank.cell_m();
    s.density_kg_m3 = scene.fluid.density_kg_m3;
    s.velocity_m_s = scene.initial.velocity_m_s;
    if (scene.smoke) s.smoke = gles::SmokeSetup{scene.smoke->dissipation_1_s};
    for (const Scene::Source& source : scene.sources) {
        gles::SourceSetup& to = s.sources.emplace_back();
        to.centre_m = source.centre_m;
        to.radius_m = source.radius_m;
        to.velocity_m_s = source.velocity_m_s;
        to.smoke_per_s = source.smoke_per_s.value_or(0.0);
        to.start_s = source.start_s;
        if (source.stop_s) to.stop_s = *source.stop_s;
    }
    for (const Scene::Body& body : scene.bodies)
        s.bodies.push_back({gles::Sphere{body.radius_m}, body.force, body.torque});
    s.solver = solver_setup(scene.solver);
    return s;
}

}  // namespace eddy
