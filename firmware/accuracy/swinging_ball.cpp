#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/accuracy/case.h"
#include "firmware/accuracy/shell_flow.h"

// B5   A ball that swings in a viscous fluid: damping b and added inertia m in F = -b U - m dU/dt, and one that is set going
//      at once. In a round shell there is an exact solution (shell_flow.h); without walls those of Stokes and Basset.

namespace eddy::accuracy {
namespace {

BallInShell ball_in_shell(const Scene& scene) {
    return {scene.bodies[0].radius_m, scene.bodies[1].radius_m, scene.fluid.density_kg_m3,
            scene.fluid.viscosity_pa_s};
}

/// b [kg/s] and m [kg] of the last swing.
std::vector<double> damping_and_inertia(Laboratory& lab) {
    const Scene::Oscillation& swing = *lab.scene().bodies[0].oscillation;
    const double omega = 2.0 * std::numbers::pi * swing.frequency_hz, speed = omega * swing.amplitude_m.x;
    Run run = lab.start();
    const long a_swing = std::lround(1.0 / (swing.frequency_hz * run.dt_s()));
    double in_phase = 0.0, out_of_phase = 0.0;
    run.step_to_end([&](const gles::StepResult& result) {
        if (result.step <= run.steps() - a_swing) return;
        // A step's force is its impulse over its length, the mean over it.
        const double middle = omega * (run.time_s() - 0.5 * run.dt_s());
        const double share = 2.0 * result.loads[0].force_n.x / static_cast<double>(a_swing);
        in_phase -= share * std::cos(middle) / speed;
        out_of_phase += share * std::sin(middle) / (speed * omega);
    });
    return {in_phase, out_of_phase};
}

Case swinging(const std::string& name, const std::string& title, const std::vector<std::string>& set) {
    Case one{.name = name,
             .title = title,
             .scene = "validation/B5",
             .set = set,
             .time_step = TimeStep::Courant,
             .parts = 3,  // half swings
             .quick = {34},
             .full = {34, 51, 68},
             .measure = damping_and_inertia};
    const Scene scene = load_scene(one.scene, one.set).scene;
    const double omega = 2.0 * std::numbers::pi * scene.bodies[0].oscillation->frequency_hz;
    const BallInShell shell = ball_in_shell(scene);
    BallInShell alone = shell;
    alone.shell_m *= 1000.0;
    const std::complex<double> z = shell.impedance({0.0, omega}), free = alone.impedance({0.0, omega});
    const auto quantity = [&](const std::string& symbol, double exact, double without_walls) {
        return Quantity{
            .name = symbol,
            .exact = exact,
            .source = fmt::format("exact in the shell; {:.5g} without walls (Stokes 1851)", without_walls),
            .error = Quantity::Error::Relative};
    };
    one.quantities = {quantity("b [kg/s]", z.real(), free.real()),
                      quantity("m [kg]", z.imag() / omega, free.imag() / omega)};
    return one;
}

Case in_glycerine() {
    Case one = swinging("B5-glycerine", "damping and added inertia of a ball that swings in glycerine", {});
    one.quantities[0].limits = {{34, 0.05}};
    one.quantities[1].limits = {{34, 0.2}, {51, 0.06}};
    return one;
}

/// Friction reaches 0.4 mm into the water, 0.16 cells on 34 and 0.32 on 68: no damping to be had from such a grid, and
/// the inertia of the flow outside that layer only. Shown, not judged.
Case in_water() {
    Case one = swinging("B5-water", "the same in water, where no grid here resolves the layer of friction",
                        {"fluid.density_kg_m3=1000", "fluid.viscosity_pa_s=0.001"});
    one.quick.clear();
    one.quantities.push_back({.name = "m [kg] but for the layer",
                              .exact = ball_in_shell(load_scene(one.scene, one.set).scene).added_mass_kg(),
                              .source = "added mass in the shell (Lamb, Hydrodynamics)",
                              .error = Quantity::Error::Relative});
    one.measure = [](Laboratory& lab) {
        std::vector<double> values = damping_and_inertia(lab);
        values.push_back(values[1]);
        return values;
    };
    return one;
}

// --- set going at once

constexpr double kTimes[] = {0.25, 0.5, 1.0};  // nu t / a^2

double stokes_drag(const Scene& scene) {
    return 6.0 * std::numbers::pi * scene.fluid.viscosity_pa_s * scene.bodies[0].radius_m;
}

double seconds(const Scene& scene, double time) {
    return time * scene.fluid.density_kg_m3 / scene.fluid.viscosity_pa_s *
           std::pow(scene.bodies[0].radius_m, 2);
}

std::vector<double> resistances(Laboratory& lab) {
    const Scene& scene = lab.scene();
    std::vector<double> ratios;
    Run run = lab.start();
    run.step_to_end([&](const gles::StepResult& result) {
        for (const double time : kTimes)
            if (std::lround(seconds(scene, time) / run.dt_s()) == result.step)
                ratios.push_back(-result.loads[0].force_n.x / scene.bodies[0].velocity_m_s.x /
                                 stokes_drag(scene));
    });
    return ratios;
}

Case set_going() {
    Case one{.name = "B5-start",
             .title = "force on a ball that is set going in glycerine, over 6 pi mu a U",
             .scene = "validation/B5-start",
             .time_step = TimeStep::Courant,
             .parts = 4,  // each of kTimes is one, two or all of them
             .quick = {34},
             .full = {34, 51, 68},
             .measure = resistances};
    const Scene scene = load_scene(one.scene).scene;
    for (const double time : kTimes)
        one.quantities.push_back(
            {.name = fmt::format("F / F_S, nu t = {} a^2", time),
             .exact = ball_in_shell(scene).resistance_after(seconds(scene, time)) / stokes_drag(scene),
             .source = fmt::format("exact in the shell; {:.4f} without walls (Basset 1888)",
                                   1.0 + 1.0 / std::sqrt(std::numbers::pi * time)),
             .error = Quantity::Error::Relative,
             .limits = {{34, 0.05}}});
    return one;
}

}  // namespace

std::vector<Case> swinging_ball_cases() {
    return {in_glycerine(), in_water(), set_going()};
}

}  // namespace eddy::accuracy
