#include "firmware/fluid_setup.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "firmware/input_error.h"
#include "firmware/npy.h"
#include "firmware/quality/quality.h"
#include "gles/body/distance_grid.h"
#include "gles/body/mesh_file.h"

namespace eddy {
namespace {

/// Nodes of a mesh's distance grid along its longest side.
constexpr int kMeshNodes = 64;

/// Of a scene's own step: in a shorter one, rounding errors in the velocities, divided by its length, are all the force there
/// is (1e-7 of 0.1 m/s over 20 us weighs as much as 1 m/s2).
constexpr double kShortestShare = 1e-3;
/// A longer step is no step of an exhibit; a scene that wants one says so.
constexpr double kLongestStepS = 0.1;

gles::SolverSetup solver_setup(const Scene::Solver& solver) {
    gles::SolverSetup s;
    switch (solver.preset) {
        case SolverPreset::Fast:
            s.viscous_cycles = 1;
            break;
        case SolverPreset::Precise:
            s.advection = gles::Advection::MacCormack;
            s.viscous_cycles = 2;
            break;
        case SolverPreset::Yang2009:
            s.method = gles::Method::Yang2009;
            break;
    }
    (solver.preset == SolverPreset::Yang2009 ? s.jacobi_sweeps : s.cycles) = usual_iterations(solver.preset);
    if (solver.advection)
        s.advection = *solver.advection == AdvectionScheme::MacCormack ? gles::Advection::MacCormack
                                                                       : gles::Advection::SemiLagrangian;
    if (solver.cycles) s.cycles = *solver.cycles;
    s.time_order = solver.time_order;
    if (solver.viscous_cycles) s.viscous_cycles = *solver.viscous_cycles;
    if (solver.jacobi_sweeps) s.jacobi_sweeps = *solver.jacobi_sweeps;
    if (solver.force_sum)
        s.force_sum = *solver.force_sum == ForceSum::Cpu ? gles::ForceSum::Cpu : gles::ForceSum::Gpu;
    return s;
}

gles::VectorFormula glsl(const FormulaVector& v, std::string& all_glsl) {
    all_glsl += v.glsl();
    return {{v.x.glsl(), v.y.glsl(), v.z.glsl()}};
}

gles::WallSetup wall_setup(const Scene::Wall& wall, std::string& all_glsl) {
    gles::WallSetup w;
    switch (wall.kind) {
        case WallKind::Slip:
            w.kind = gles::WallKind::Slip;
            break;
        case WallKind::NoSlip:
            w.kind = gles::WallKind::NoSlip;
            break;
        case WallKind::Inflow:
            w.kind = gles::WallKind::Inflow;
            break;
        case WallKind::Open:
            w.kind = gles::WallKind::Open;
            break;
    }
    if (!wall.velocity_m_s) return w;
    w.velocity_m_s = glsl(*wall.velocity_m_s, all_glsl);
    w.velocity_at = [u = *wall.velocity_m_s](const glm::dvec3& x_m, double t_s) {
        return u.evaluate(x_m, t_s);
    };
    w.varies_in_space =
        wall.velocity_m_s->uses('x') || wall.velocity_m_s->uses('y') || wall.velocity_m_s->uses('z');
    w.varies_in_time = wall.velocity_m_s->uses('t');
    return w;
}

gles::Mesh mesh(const Scene::Body& body, double cell_m) {
    try {
        return {std::make_shared<gles::DistanceGrid>(gles::read_mesh(body.file.string(), body.scale),
                                                     kMeshNodes, 2.0 * cell_m)};
    } catch (const gles::MeshError& e) {
        throw InputError(e.what());
    }
}

gles::Shape shape(const Scene::Body& b, double cell_m) {
    switch (b.shape) {
        case BodyShape::Sphere:
            return gles::Sphere{b.radius_m};
        case BodyShape::Box:
            return gles::Cuboid{b.size_m};
        case BodyShape::Capsule:
            return gles::Capsule{b.radius_m, b.length_m};
        case BodyShape::Cylinder:
            return gles::Cylinder{b.radius_m, b.length_m};
        case BodyShape::Torus:
            return gles::Torus{b.radius_m, b.tube_radius_m};
        case BodyShape::Ellipsoid:
            return gles::Ellipsoid{b.radii_m};
        case BodyShape::Disk:
            return gles::Cylinder{b.radius_m, b.thickness_m};
        case BodyShape::Paddle:
            return gles::Paddle{b.blade_m, b.handle_radius_m, b.handle_length_m};
        case BodyShape::Tetrahedron:
            return gles::Tetrahedron{b.edge_m};
        case BodyShape::Mesh:
            return mesh(b, cell_m);
    }
    throw std::logic_error("a body shape without a solid");
}

/// The velocity that a simulation of the same tank has written.
std::vector<glm::vec3> velocities(const Scene& scene) {
    const std::filesystem::path& file = scene.initial.velocity_npy;
    const NpyArray array = read_npy(file);
    const glm::ivec3 n = scene.tank.cells + (scene.solver.preset == SolverPreset::Yang2009 ? 0 : 1);
    const std::vector<int> shape{n.z, n.y, n.x, 3};
    if (array.shape != shape)
        throw InputError(fmt::format(
            "{}: its shape is [{}], but this tank and solver have [{}]: write it with outputs.fields from a "
            "scene with the same tank.cells and a preset of the same kind",
            file.string(), fmt::join(array.shape, ", "), fmt::join(shape, ", ")));
    std::vector<glm::vec3> u;
    for (std::size_t i = 0; i < array.values.size(); i += 3) {
        u.emplace_back(array.values[i], array.values[i + 1], array.values[i + 2]);
        if (!std::isfinite(u.back().x + u.back().y + u.back().z))
            throw InputError(fmt::format("{}: velocity number {} is not finite", file.string(), i / 3));
    }
    return u;
}

/// What of a body the fluid decides.
std::optional<gles::Coupled> coupled(const Scene::Body& body, double fluid_density_kg_m3) {
    const bool free = body.motion == BodyMotion::Free;
    if (!free && !body.turning) return std::nullopt;
    return gles::Coupled{body.density_kg_m3.value_or(fluid_density_kg_m3), free, true};
}

}  // namespace

gles::FluidSetup fluid_setup(const Scene& scene) {
    gles::FluidSetup s;
    s.cells = scene.tank.cells;
    s.cell_m = scene.tank.cell_m();
    s.density_kg_m3 = scene.fluid.density_kg_m3;
    s.viscosity_pa_s = scene.fluid.viscosity_pa_s;
    s.gravity_m_s2 = scene.fluid.gravity_m_s2;
    s.shortest_step_s = kShortestShare * scene.solver.dt_s;
    s.longest_step_s = std::max(kLongestStepS, scene.solver.dt_s);
    std::string all_glsl;
    const auto walls = scene.tank.walls.all();
    for (std::size_t i = 0; i < walls.size(); ++i) s.walls[i] = wall_setup(*walls[i], all_glsl);
    if (scene.vorticity_confinement) s.confinement_1_s = scene.vorticity_confinement->strength_1_s;
    if (scene.forcing) s.acceleration_m_s2 = glsl(scene.forcing->acceleration_m_s2, all_glsl);
    if (scene.imposed)
        s.imposed = {glsl(scene.imposed->velocity_m_s, all_glsl), !scene.imposed->velocity_m_s.uses('t')};
    s.formula_helpers = formula_helpers(all_glsl);
    if (!scene.initial.velocity_npy.empty()) s.velocities_at_start = velocities(scene);
    s.velocity_at_start = [u = scene.initial.velocity_m_s](const glm::dvec3& x_m) {
        return u.evaluate(x_m, 0.0);
    };
    if (scene.smoke) {
        gles::SmokeSetup& smoke = s.smoke.emplace();
        smoke.dissipation_1_s = scene.smoke->dissipation_1_s;
        smoke.weight = scene.smoke->weight;
        smoke.at_start = [density = scene.smoke->initial](const glm::dvec3& x_m) {
            return density.evaluate(x_m.x, x_m.y, x_m.z, 0.0);
        };
    }
    if (scene.temperature) {
        gles::TemperatureSetup& heat = s.temperature.emplace();
        heat.expansion_1_k = scene.temperature->expansion_1_k;
        heat.diffusivity_m2_s = scene.temperature->diffusivity_m2_s;
        heat.at_start_k = [excess = scene.temperature->initial_k](const glm::dvec3& x_m) {
            return excess.evaluate(x_m.x, x_m.y, x_m.z, 0.0);
        };
    }
    for (const Scene::Source& source : scene.sources) {
        gles::SourceSetup& to = s.sources.emplace_back();
        to.centre_m = source.centre_m;
        to.radius_m = source.radius_m;
        to.velocity_m_s = source.velocity_m_s;
        to.smoke_per_s = source.smoke_per_s.value_or(0.0);
        to.temperature_k_per_s = source.temperature_k_per_s.value_or(0.0);
        to.start_s = source.start_s;
        if (source.stop_s) to.stop_s = *source.stop_s;
    }
    for (const Scene::Body& body : scene.bodies)
        s.bodies.push_back({shape(body, s.cell_m), body.inside_out, body.force, body.torque,
                            coupled(body, s.density_kg_m3)});
    s.force_methods = scene.outputs.force_methods;
    s.solver = solver_setup(scene.solver);
    return s;
}

}  // namespace eddy
