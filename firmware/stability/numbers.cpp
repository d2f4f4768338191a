#include <fmt/format.h>

#include "firmware/stability/case.h"
#include "firmware/stability/criteria.h"
#include "firmware/stability/rule.h"
#include "firmware/stability/scene_parts.h"

namespace eddy::stability {
namespace {

/// How far a force in other units may be off, as a share of its peak: what single rounding errors make of it (validation B8.11).
constexpr double kRounding = 1e-5;

/// 28: everything that has a length, or a density, or a viscosity, is that many times what it was.
Case scaled(const char* name, const char* title, double lengths, double densities, double viscosity_m2_s) {
    Case one{.number = 28,
             .name = name,
             .title = title,
             .provokes = "numbers that leave the range of 32 bits when they are multiplied",
             .change = [=](Scene& s) {
                 Scene big = s;
                 big.tank.size_m *= lengths;
                 if (s.smoke) big.smoke->initial = Formula(0.5);
                 for (Scene::Body& body : big.bodies) {
                     body.centre_m *= lengths;
                     body.radius_m *= lengths;
                     body.size_m *= lengths;
                     if (body.oscillation) body.oscillation->amplitude_m *= lengths;
                 }
                 big.haptics.centre_m *= lengths;
                 big.fluid.density_kg_m3 *= densities;
                 big.fluid.viscosity_pa_s = viscosity_m2_s * big.fluid.density_kg_m3;
                 s = big;
             }};
    if (viscosity_m2_s > 0.0) return one;  // another flow
    const double forces =
        densities * lengths * lengths * lengths * lengths;  // rho L^4 / T^2, with the same T
    one.wants = "but for the units the force is that of the common scene, to 1e-5 of its peak";
    one.complaint = same_as_common(forces, kRounding);
    one.remark = remark_on_common(forces);
    one.compares = true;
    return one;
}

Case grid(const glm::ivec3& cells, bool large) {
    return {.number = 27,
            .name = "grid-" + grid_name(cells),
            .title = fmt::format("the common scene on {}", grid_name(cells)),
            .provokes = "halving odd numbers, slices that bleed into each other, off by one at a far wall",
            .wants = "the fluid gives back no more energy than it was given",
            .complaint = gives_back_no_more(),
            .steps = large ? 20 : 500,
            .calm_share = large ? 0.0 : 0.5,
            .full_only = large,
            .grids = {cells}};
}

/// 26: 1 and -1 from cell to cell, h wide; at faces as well.
Formula checkerboard(double cell_m) {
    return Formula::parse(
        fmt::format("0.1 - 0.2 * mod(floor(x / {0:.12g} + 0.25) + floor(y / {0:.12g} + 0.25) + floor(z / "
                    "{0:.12g} + 0.25), 2)",
                    cell_m));
}

}  // namespace

std::vector<Case> number_cases() {
    std::vector<Case> cases;
    cases.push_back({.number = 22,
                     .name = "past-65504",
                     .title = "a jet at 1e5 m/s and smoke that thickens by 1e6 a second",
                     .provokes = "half floats overflow at 65504",
                     .change =
                         [](Scene& s) {
                             Scene::Source& jet = s.sources.emplace_back();
                             jet.name = "jet";
                             jet.centre_m = s.tank.size_m * glm::dvec3(0.22, 0.5, 0.5);
                             jet.radius_m = 0.2 * shortest_side_m(s);
                             jet.velocity_m_s = glm::dvec3(1e5, 0.0, 0.0);
                             jet.smoke_per_s = 1e6;
                         },
                     .script = [](Moment& m) { m.hand_m = m.middle_m(); },
                     .calm_share = 0.0,
                     .calm_s = kCalmS});
    cases.push_back(
        {.number = 22,
         .name = "below-6e-8",
         .title =
             "smoke fades and a stir dies away until both are below the smallest half float, and below the "
             "smallest float",
         .provokes = "underflow freezes a field; denormal numbers are slow",
         .change =
             [](Scene& s) {
                 s.smoke->dissipation_1_s = 20.0;
                 all_walls(s, WallKind::NoSlip);
                 s.fluid.viscosity_pa_s = 0.05;
             },
         .remark = remark_on_time(),
         .least_steps = 500});
    cases.push_back({.number = 26,
                     .name = "checkerboard-velocity",
                     .title = "the velocity changes its sign from cell to cell at the start",
                     .provokes = "a mode that the pressure does not see",
                     .wants = "a tenth of its energy is left after 100 steps",
                     .change =
                         [](Scene& s) {
                             s.bodies.clear();
                             const Formula board = checkerboard(s.tank.cell_m());
                             s.initial.velocity_m_s = {board, board, board};
                         },
                     .complaint = energy_decays(100),
                     .steps = 200,
                     .least_steps = 120,
                     .calm_share = 0.0});
    cases.push_back(
        {.number = 26,
         .name = "checkerboard-pressure",
         .title = "the pressure changes its sign from cell to cell after ten steps, while the ball stirs",
         .provokes = "a mode that sweeps do not see, kept by the warm start",
         .wants = "40 steps later the force differs from that without it by a tenth of what it did",
         .script =
             [](Moment& m) {
                 if (m.step == 10) m.faults = {{Fault::Place::Pressure, 0.1f, Fault::Extent::Checkerboard}};
             },
         .complaint = is_forgotten(10, 40),
         .compares = true,
         .puts_faults = true,
         .pardon_steps = 5});
    for (const glm::ivec3& cells : {glm::ivec3(8), glm::ivec3(9), glm::ivec3(25), glm::ivec3(31)})
        cases.push_back(grid(cells, false));
    for (const glm::ivec3& cells :
         {glm::ivec3(16, 64, 24), glm::ivec3(128, 8, 8), glm::ivec3(127), glm::ivec3(128)})
        cases.push_back(grid(cells, true));
    // By powers of two, which round nothing: what differs then depends on the units.
    cases.push_back(scaled("millimetres", "a tank of 0.16 mm", 0x1p-10, 1.0, 0.0));
    cases.push_back(scaled("kilometres", "a tank of 160 m", 0x1p10, 1.0, 0.0));
    cases.push_back(scaled("thin-as-vacuum", "a density of 1e-3 kg/m3", 1.0, 0x1p-10, 0.0));
    cases.push_back(scaled("heavy", "a density of 1e4 kg/m3", 1.0, 0x1p13, 0.0));
    cases.push_back(scaled("superfluid", "a viscosity of 1e-9 m2/s", 1.0, 1.0, 1e-9));
    cases.push_back(scaled("pitch", "a viscosity of 100 m2/s", 1.0, 1.0, 100.0));
    return cases;
}

}  // namespace eddy::stability
