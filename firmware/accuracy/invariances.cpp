#include <algorithm>
#include <cmath>

#include "firmware/accuracy/convergence.h"
#include "firmware/accuracy/identity.h"

// B8.4   The force turns, and is mirrored, with the scene.
// B8.5   A cube in the middle of a round shell feels the same force whichever way it is turned, and none aside.
// B8.8   The same motion in steps half as long: the same force, to first order.
// B8.9   The force of a fluid at rest does not know its pressure from one that is higher everywhere.
// B8.11  Nor does it know the units in which all is measured.
// B8.12  A body outside the tank feels nothing.

namespace eddy::accuracy {
namespace {

using Loads = std::vector<gles::Load>;

/// Of each step.
std::vector<Loads> history(Laboratory& lab, const Scene& scene) {
    std::vector<Loads> all;
    lab.start(scene).step_to_end([&](const gles::StepResult& result) { all.push_back(result.loads); });
    return all;
}

/// rms over steps and bodies.
double rms_force(const std::vector<Loads>& all) {
    double sum = 0.0, count = 0.0;
    for (const Loads& loads : all)
        for (const gles::Load& load : loads) {
            sum += glm::dot(load.force_n, load.force_n);
            ++count;
        }
    return std::sqrt(sum / count);
}

/// rms of the difference between two histories, the first of them turned, over the rms force.
double difference(const std::vector<Loads>& one, const std::vector<Loads>& other,
                  const glm::dmat3& turn = glm::dmat3(1.0)) {
    std::vector<Loads> between = other;
    for (std::size_t n = 0; n < one.size(); ++n)
        for (std::size_t i = 0; i < one[n].size(); ++i) between[n][i].force_n -= turn * one[n][i].force_n;
    return rms_force(between) / rms_force(one);
}

// --- B8.4

/// The scene turned or mirrored about the middle of its tank, all of whose walls are alike.
Scene turned(const Scene& scene, const glm::dmat3& turn) {
    const double handedness = glm::determinant(turn);  // of a spin, and of the axis of an angle
    Scene t = scene;
    t.tank.size_m = glm::abs(turn * scene.tank.size_m);
    t.tank.cells = glm::ivec3(glm::round(glm::abs(turn * glm::dvec3(scene.tank.cells))));
    for (Scene::Body& body : t.bodies) {
        body.centre_m = 0.5 * t.tank.size_m + turn * (body.centre_m - 0.5 * scene.tank.size_m);
        body.size_m = glm::abs(turn * body.size_m);
        body.axis = handedness * (turn * body.axis);
        if (!body.oscillation) continue;
        body.oscillation->amplitude_m = turn * body.oscillation->amplitude_m;
        body.oscillation->axis = handedness * (turn * body.oscillation->axis);
    }
    return t;
}

/// Semi-Lagrangian transport carries the three faces of a cell along one path (setup.h), which no turn leaves as it was: 6 % of
/// the force with `fast`. With MacCormack what is left is the pressure's, 5e-4 with 3 cycles and 2e-6 with 14.
std::vector<double> asymmetry(Laboratory& lab, const Scene& scene) {
    const glm::dmat3 third_about_diagonal({0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}),
        mirror_x({-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
    const std::vector<Loads> plain = history(lab, scene);
    const auto off = [&](const glm::dmat3& turn) {
        return difference(plain, history(lab, turned(scene, turn)), turn);
    };
    return {off(third_about_diagonal), off(mirror_x)};
}

// --- B8.5

std::vector<double> anisotropy(Laboratory& lab, Scene scene) {
    Scene::Body& cube = scene.bodies[0];
    cube.shape = BodyShape::Box;
    cube.size_m = glm::dvec3(1.6 * cube.radius_m);
    const glm::dvec3 ahead = glm::normalize(cube.acceleration_m_s2);
    double least = 0.0, most = 0.0, aside = 0.0;
    for (const auto& [axis, angle_deg] :
         {std::pair(glm::dvec3(0.0, 0.0, 1.0), 0.0), std::pair(glm::dvec3(0.0, 0.0, 1.0), 20.0),
          std::pair(glm::dvec3(0.0, 0.0, 1.0), 45.0), std::pair(glm::dvec3(1.0, 2.0, 0.5), 35.0),
          std::pair(glm::dvec3(0.3, -0.2, 1.0), 70.0)}) {
        cube.axis = axis;
        cube.angle_deg = angle_deg;
        const glm::dvec3 force = lab.start(scene).step_to_end().loads[0].force_n;
        const double along = -glm::dot(force, ahead);
        least = angle_deg == 0.0 ? along : std::min(least, along);
        most = worse(most, along);
        aside = worse(aside, glm::length(force + along * ahead));
    }
    return {(most - least) / most, aside / most};
}

// --- B8.8

/// Forces on all bodies at the scene's end.
std::vector<glm::dvec3> last_forces(Laboratory& lab, Scene scene, int steps_in_one) {
    scene.solver.dt_s /= steps_in_one;
    std::vector<glm::dvec3> forces;
    for (const gles::Load& load : lab.start(scene).step_to_end().loads) forces.push_back(load.force_n);
    return forces;
}

double distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
    return std::sqrt(sum);
}

/// On 50 cells `precise` falls short: of order 0.7, with 9 cycles of the pressure as with 3.
std::vector<double> change_with_step(Laboratory& lab, const Scene& scene) {
    const auto whole = last_forces(lab, scene, 1), half = last_forces(lab, scene, 2),
               quarter = last_forces(lab, scene, 4);
    const double first = distance(whole, half), second = distance(half, quarter);
    return {std::log2(first / second),
            first / distance(whole, std::vector<glm::dvec3>(whole.size(), glm::dvec3(0.0)))};
}

// --- B8.9

/// Bodies at rest in water that weighs: under a closed lid the mean of the pressure is 0, under an open one it is 0 there.
std::vector<double> change_with_lid(Laboratory& lab, Scene scene) {
    scene.fluid.gravity_m_s2 = {0.0, -9.81, 0.0};
    for (Scene::Body& body : scene.bodies) {
        body.motion = BodyMotion::Fixed;
        body.oscillation.reset();
    }
    const auto closed = last_forces(lab, scene, 1);
    scene.tank.walls.y_high.kind = WallKind::Open;
    const auto open = last_forces(lab, scene, 1);
    return {distance(closed, open) /
            distance(closed, std::vector<glm::dvec3>(closed.size(), glm::dvec3(0.0)))};
}

// --- B8.11

/// The scene in units of which there are so many in a metre, a kilogram and a second.
Scene in_units(Scene scene, double m, double kg, double s) {
    scene.tank.size_m *= m;
    scene.fluid.density_kg_m3 *= kg / (m * m * m);
    scene.solver.dt_s *= s;
    scene.outputs.duration_s *= s;
    for (Scene::Body& body : scene.bodies) {
        body.centre_m *= m;
        body.radius_m *= m;
        body.size_m *= m;
        if (!body.oscillation) continue;
        body.oscillation->amplitude_m *= m;
        body.oscillation->frequency_hz /= s;
    }
    return scene;
}

std::vector<double> change_with_units(Laboratory& lab, const Scene& scene) {
    const std::vector<Loads> si = history(lab, scene);
    const auto change = [&](double m, double kg, double s) {
        const double newton = kg * m / (s * s);
        return difference(si, history(lab, in_units(scene, m, kg, s)), glm::dmat3(newton)) / newton;
    };
    return {worse(change(1e3, 1e3, 1.0), change(1e-3, 1e-3, 1.0 / 3600.0))};
}

// --- B8.12

std::vector<double> force_outside(Laboratory& lab, Scene scene) {
    scene.bodies[0].centre_m.x += 4.0 * scene.tank.size_m.x;
    double most = 0.0;
    for (const Loads& loads : history(lab, scene))
        most = worse(most, worse(glm::length(loads[0].force_n), glm::length(loads[0].torque_nm)));
    return {most};
}

}  // namespace

std::vector<Case> invariance_cases() {
    const auto turns = [](const char* name) {
        return Quantity{.name = name, .source = "symmetry; rms", .limits = {{25, 1e-3}}};
    };
    return {
        at_both_presets({.name = "B8.4",
                         .title = "how far the force does not turn, or is not mirrored, with the scene",
                         .quantities = {turns("turned, dF / F"), turns("mirrored, dF / F")},
                         .measure = asymmetry}),
        at_both_presets(
            {.name = "B8.5",
             .title = "a cube that speeds up in a round shell, at five angles",
             .scene = "validation/B2-shell",
             .quantities = {{.name = "scatter of F",
                             .source = "a cube is the same to all directions in a tensor",
                             .limits = {{26, 0.05}}},
                            {.name = "F aside / F ahead", .source = "the same", .limits = {{26, 0.02}}}},
             .measure = anisotropy,
             .quick = {26},
             .full = {26, 39, 52}}),
        at_both_presets({.name = "B8.8",
                         .title = "the force at dt, dt / 2 and dt / 4",
                         .quantities = {{.name = "order",
                                         .exact = 1.0,
                                         .source = "first-order splitting",
                                         .error = Quantity::Error::Shortfall,
                                         .limits = {{25, 0.2}}},
                                        {.name = "F(dt) - F(dt / 2), / F",
                                         .source = "the same motion",
                                         .limits = {{25, 0.1}}}},
                         .measure = change_with_step}),
        at_both_presets({.name = "B8.9",
                         .title = "lift in water at rest, its pressure from a closed lid's or an open one's",
                         .quantities = {{.name = "dF / F",
                                         .source = "a closed surface does not feel a constant",
                                         .limits = {{25, 1e-3}}}},
                         .measure = change_with_lid}),
        at_both_presets({.name = "B8.11",
                         .title = "the same in mm, g, s and in km, t, h",
                         .quantities = {{.name = "dF / F", .source = "similarity", .limits = {{25, 1e-5}}}},
                         .measure = change_with_units}),
        at_both_presets({.name = "B8.12",
                         .title = "force and torque on a body outside the tank",
                         .quantities = {{.name = "F [N], T [N m]",
                                         .source = "no fluid touches it",
                                         .limits = {{25, 0.0}}}},
                         .measure = force_outside})};
}

}  // namespace eddy::accuracy
