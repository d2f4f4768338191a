#include <cmath>
#include <functional>

#include "gles/fluid/face_shares.h"
#include "gles/fluid/transport.h"
#include "gles/grid_io.h"
#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using Momentum = GlTest;

/// Two bodies on their way through a tank that is no cube; what they displace is not the same everywhere.
struct TwoBodies {
    FluidSetup setup = unit_tank({17, 22, 13}, 2.6, Advection::SemiLagrangian, 16);
    std::vector<BodyState> states;

    explicit TwoBodies(Advection advection) {
        setup.solver.advection = advection;
        setup.bodies.push_back(BodySetup{Cuboid{{4.0, 3.0, 5.0}}});
        states.push_back({.centre_m = {6.2, 5.6, 5.7}, .velocity_m_s = {0.2, 0.3, -0.1}});
        states.push_back({.centre_m = {9.3, 15.2, 6.6},
                          .orientation = glm::angleAxis(0.6, glm::normalize(glm::dvec3(1.0, 2.0, 0.5))),
                          .velocity_m_s = {-0.1, 0.15, 0.1},
                          .spin_rad_s = {0.05, -0.04, 0.08}});
    }
    void move(double dt) {
        for (BodyState& s : states) s.centre_m += dt * s.velocity_m_s;
    }
};

/// sum (1 - a) u_solid over all faces that are not walls, each body's faces with its own velocity: by the nearest body,
/// as the solver does. Both bodies are far enough apart for a plane between them to say which that is.
glm::dvec3 solid_flux(const OnFaces& a, const std::vector<BodyState>& states, double between_y) {
    glm::dvec3 total(0.0);
    const glm::ivec3 n = a.cells;
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j)
            for (int i = 0; i < n.x; ++i)
                for (int c = 0; c < 3; ++c) {
                    const glm::ivec3 cell(i, j, k);
                    if (cell[c] == 0) continue;
                    glm::dvec3 x = glm::dvec3(cell) + 0.5;
                    x[c] -= 0.5;
                    const BodyState& s = states[x.y < between_y ? 0 : 1];
                    const glm::dvec3 u = s.velocity_m_s + glm::cross(s.spin_rad_s, x - s.centre_m);
                    total[c] += (1.0 - a.values[a.index(cell)][c]) * u[c];
                }
    return total;
}

TEST_F(Momentum, OfAllTheFluidIsMinusThatOfWhatTheBodiesDisplace) {
    // Identity B8.1, with bodies that turn, have edges, and are two: sum (a u + (1 - a) u_solid) = 0 in a closed box.
    TwoBodies scene(Advection::MacCormack);
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, scene.setup);
    for (int step = 0; step < 4; ++step) {
        scene.move(1.0);
        fluid->step(1.0, scene.states, false);
    }
    const OnFaces a = face_shares(gpu, scene.setup, scene.states);
    const glm::dvec3 of_fluid = sum(a, fluid->velocity());
    const glm::dvec3 of_solids = solid_flux(a, scene.states, 10.9);
    record("relative", glm::length(of_fluid + of_solids) / glm::length(of_solids));
    EXPECT_LT(glm::length(of_fluid + of_solids), 1e-4 * glm::length(of_solids));
}

/// Force of the fluid on the tank's walls: the pressure in the cells beside them, p h^2 on each.
glm::dvec3 force_on_walls(const Fluid& fluid) {
    const glm::ivec3 n = fluid.setup().cells;
    const std::vector<float> p = fluid.pressure();
    const auto at = [&](int i, int j, int k) {
        return static_cast<double>(p[static_cast<std::size_t>((k * n.y + j) * n.x + i)]);
    };
    glm::dvec3 f(0.0);
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j) f.x += at(n.x - 1, j, k) - at(0, j, k);
    for (int k = 0; k < n.z; ++k)
        for (int i = 0; i < n.x; ++i) f.y += at(i, n.y - 1, k) - at(i, 0, k);
    for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) f.z += at(i, j, n.z - 1) - at(i, j, 0);
    return f;
}

/// Worst residual of the balance over a few steps, relative to the larger of force and momentum rate; cycles of
/// the preset or many. What transport that does not conserve momentum makes or loses is `deficit`, on the same scale.
struct Balance {
    double residual = 0.0, deficit = 0.0;
};
Balance balance(Gpu& gpu, Advection advection, int cycles) {
    TwoBodies scene(advection);
    scene.setup.solver.cycles = cycles;
    scene.setup.gravity_m_s2 = {0.02, -0.05, 0.01};
    const double dt = 1.0;
    const std::unique_ptr<Fluid> fluid = make_fluid(gpu, scene.setup);
    const Walls walls(scene.setup);
    VelocityTransport transport(gpu, scene.setup, walls);
    Field<Faces> before(gpu, scene.setup.cells, Format::RGBA32F);
    Balance worst;
    for (int step = 0; step < 5; ++step) {
        const std::vector<glm::vec4> texels = pack_vectors(fluid->velocity(), before.layout());
        before.texture().upload(&texels[0].x);
        const Field<Faces> advected = transport(before, before, dt, walls.time(0.0));
        const std::vector<glm::vec3> u_advected =
            unpack_vectors(advected.texture().download(), advected.layout());
        const std::vector<glm::vec3> u_before = fluid->velocity();
        const OnFaces a_before = face_shares(gpu, scene.setup, scene.states);

        scene.move(dt);
        fluid->step(dt, scene.states, false);
        const std::vector<Load> loads = fluid->wait_result().loads;
        const OnFaces a = face_shares(gpu, scene.setup, scene.states);
        const glm::dvec3 weight =
            scene.setup.gravity_m_s2 * sum(a, std::vector<glm::vec3>(u_before.size(), glm::vec3(1.0f)));
        const glm::dvec3 gained = (sum(a, fluid->velocity()) - sum(a, u_advected)) / dt;
        const glm::dvec3 given = loads[0].force_n + loads[1].force_n + force_on_walls(*fluid);
        const double scale = glm::length(loads[0].force_n) + glm::length(loads[1].force_n);
        worst.residual = std::max(worst.residual, glm::length(gained - weight + given) / scale);
        worst.deficit =
            std::max(worst.deficit, glm::length(sum(a, u_advected) - sum(a_before, u_before)) / dt / scale);
    }
    return worst;
}

TEST_F(Momentum, GainedByTheFluidIsWhatItsWeightBringsLessWhatBodiesAndWallsTake) {
    // Identity B8.2. Between transport and the end of the step this holds face by face, however well the pressure is
    // solved, because the force is the sum of the same pressure differences that the projection takes from the velocity.
    for (const Advection advection : {Advection::SemiLagrangian, Advection::MacCormack}) {
        const bool fast = advection == Advection::SemiLagrangian;
        const Balance well = balance(gpu, advection, 16), preset = balance(gpu, advection, fast ? 2 : 3);
        record(fast ? "residual_fast" : "residual_precise", preset.residual);
        record(fast ? "transport_deficit_fast" : "transport_deficit_precise", preset.deficit);
        EXPECT_LT(well.residual, 1e-4);
        EXPECT_LT(preset.residual, 1e-4);
    }
}

}  // namespace
}  // namespace eddy::gles
