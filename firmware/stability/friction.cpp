#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "firmware/stability/case.h"
#include "firmware/stability/criteria.h"
#include "firmware/stability/scene_parts.h"

namespace eddy::stability {
namespace {

/// Vortices of Taylor and Green between slip walls, 0.1 m/s, in x and y, and no body.
void vortices(Scene& s) {
    s.bodies.clear();
    s.smoke.reset();
    const double kx = std::numbers::pi / s.tank.size_m.x, ky = std::numbers::pi / s.tank.size_m.y;
    s.initial.velocity_m_s = vector_of(
        Formula::parse(fmt::format("0.1 * sin({:.9g} * x) * cos({:.9g} * y)", kx, ky)),
        Formula::parse(fmt::format("-{:.9g} * cos({:.9g} * x) * sin({:.9g} * y)", 0.1 * kx / ky, kx, ky)),
        0.0);
}

/// How far a flow on cells is off what becomes of those vortices with friction (validation A1), as a share of them at the start.
double off_the_decay(gles::Gpu&, const gles::Fluid& fluid, const Fields& fields, double time_s) {
    const gles::FluidSetup& setup = fluid.setup();
    const glm::ivec3 n = setup.cells;
    const double kx = std::numbers::pi / (setup.cell_m * n.x), ky = std::numbers::pi / (setup.cell_m * n.y);
    const double left = std::exp(-setup.viscosity_pa_s / setup.density_kg_m3 * (kx * kx + ky * ky) * time_s);
    double off = 0.0, start = 0.0;
    std::size_t i = 0;
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x, ++i) {
                const double at_x = kx * setup.cell_m * (x + 0.5), at_y = ky * setup.cell_m * (y + 0.5);
                const glm::dvec3 exact(0.1 * std::sin(at_x) * std::cos(at_y),
                                       -0.1 * kx / ky * std::cos(at_x) * std::sin(at_y), 0.0);
                const glm::dvec3 apart = glm::dvec3(fields.velocity_m_s.at(i)) - left * exact;
                off += glm::dot(apart, apart);
                start += glm::dot(exact, exact);
            }
    return std::sqrt(off / start);
}

/// 14
Case inviscid(const char* name, const char* title, std::function<void(Scene&)> transport) {
    return {.number = 14,
            .name = name,
            .title = title,
            .provokes = "transport that makes energy",
            .wants = "kinetic energy never rises by more than 0.1 %",
            .change =
                [transport](Scene& s) {
                    vortices(s);
                    transport(s);
                },
            .complaint = energy_never_rises(),
            .steps = 10000,
            .calm_share = 0.0,
            .full_only = true,
            .grids = {glm::ivec3(8), glm::ivec3(16), glm::ivec3(25)}};
}

/// 15: nu dt / h^2 is this.
void syrup(Scene& s, double diffusion) {
    s.fluid.viscosity_pa_s =
        diffusion * s.fluid.density_kg_m3 * s.tank.cell_m() * s.tank.cell_m() / s.solver.dt_s;
}

Case thick(double diffusion) {
    return {.number = 15,
            .name = fmt::format("friction-{:g}", diffusion),
            .title = fmt::format("friction reaches sqrt({:g}) cells in a step, at rest walls", diffusion),
            .provokes = "an explicit step, stable to 1/6 only",
            .wants = "no speed is higher than at the start",
            .change =
                [diffusion](Scene& s) {
                    vortices(s);
                    all_walls(s, WallKind::NoSlip);
                    syrup(s, diffusion);
                },
            .complaint = speed_never_rises(),
            .calm_share = 1.0};
}

}  // namespace

std::vector<Case> friction_cases() {
    std::vector<Case> cases;
    cases.push_back(inviscid("inviscid-first-order",
                             "vortices without friction, semi-Lagrangian, 10 000 steps",
                             [](Scene& s) { s.solver.advection = AdvectionScheme::SemiLagrangian; }));
    cases.push_back(inviscid("inviscid-maccormack", "vortices without friction, MacCormack, 10 000 steps",
                             [](Scene& s) { s.solver.advection = AdvectionScheme::MacCormack; }));
    cases.push_back(inviscid("inviscid-reflection",
                             "vortices without friction, MacCormack, second order in time, 10 000 steps",
                             [](Scene& s) {
                                 s.solver.advection = AdvectionScheme::MacCormack;
                                 s.solver.time_order = 2;
                             }));
    for (const double diffusion : {0.1, 1.0, 10.0, 1000.0}) cases.push_back(thick(diffusion));
    cases.push_back({.number = 15,
                     .name = "friction-1000-stirred",
                     .title = "the ball stirs a fluid in which friction reaches 32 cells in a step",
                     .provokes = "an explicit step; a viscous guess that is far off",
                     .change = [](Scene& s) {
                         all_walls(s, WallKind::NoSlip);
                         syrup(s, 1000.0);
                     }});
    cases.push_back(
        {.number = 16,
         .name = "jacobi-stopped-early",
         .title = "the method of 2009 with friction over 32 cells, its Jacobi sweeps stopped early",
         .provokes = "a fixed point that is wrong: the box seems to float",
         .wants = "no speed is higher than at the start",
         .change =
             [](Scene& s) {
                 vortices(s);
                 syrup(s, 1000.0);
                 s.solver.jacobi_sweeps = s.solver.cycles ? 5 : 40;
                 s.solver.preset = SolverPreset::Yang2009;
                 s.solver.cycles.reset();
                 s.solver.viscous_cycles.reset();
             },
         .measure = off_the_decay,
         .complaint = speed_never_rises(),
         .remark =
             [](const History& history) {
                 if (history.looks.empty()) return std::string();
                 return fmt::format(
                     "the exact flow is at rest; after the first step {:.2g} of it are left, after the last "
                     "{:.2g}",
                     history.looks.front().measured, history.looks.back().measured);
             },
         .calm_share = 1.0,
         .alone = true});
    cases.push_back({.number = 29,
                     .name = "time-reversal",
                     .title = "the flow is turned back after a while, without friction",
                     .provokes = "a scheme that is not reversible: energy from nowhere on the way back",
                     .wants = "kinetic energy never rises by more than 0.1 %",
                     .drive = Drive::Steps,
                     .change = vortices,
                     .script =
                         [](Moment& m) {
                             if (m.step == 50)
                                 m.flow = [](std::vector<glm::vec3>& u) {
                                     for (glm::vec3& v : u) v = -v;
                                 };
                         },
                     .complaint = energy_never_rises(),
                     .remark = remark_on_energy(),
                     .steps = 100,
                     .least_steps = 100,
                     .calm_share = 0.0});
    return cases;
}

}  // namespace eddy::stability
