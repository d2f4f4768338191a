#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/accuracy/convergence.h"
#include "firmware/accuracy/identity.h"

// B8.13  What body i feels of the motion of body j, j feels of the same motion of i: the matrix of added masses, and that of
//        resistances in creeping flow, are symmetric (Lorentz 1896).

namespace eddy::accuracy {
namespace {

/// Rows are what is felt: three forces and three torques, body after body; columns the motions that are felt, alike.
using Matrix = std::vector<std::vector<double>>;

constexpr double kSpeed = 1e-5, kSpin = 1e-4;  // [m/s], [1/s]: nobody moves far enough to change the matrix

double felt(const gles::Load& load, std::size_t way) {
    const auto k = static_cast<int>(way % 3);
    return way < 3 ? load.force_n[k] : load.torque_nm[k];
}

Matrix matrix(Laboratory& lab, const Scene& at_rest) {
    const std::size_t ways = 6 * at_rest.bodies.size();
    Matrix m(ways, std::vector<double>(ways));
    for (std::size_t j = 0; j < ways; ++j) {
        Scene scene = at_rest;
        Scene::Body& mover = scene.bodies[j / 6];
        const bool spins = j % 6 >= 3;
        (spins ? mover.spin_rad_s : mover.velocity_m_s)[static_cast<int>(j % 3)] = spins ? kSpin : kSpeed;
        const std::vector<gles::Load> loads = lab.start(scene).step_to_end().loads;
        for (std::size_t i = 0; i < ways; ++i)
            m[i][j] = -felt(loads[i / 6], i % 6) / (spins ? kSpin : kSpeed);
    }
    return m;
}

/// Largest |m_ij - m_ji| over sqrt(m_ii m_jj), among the ways that the fluid resists: without friction a ball that turns moves
/// nothing but what the grid makes of its surface. Inertia of turning is in kg m^2; that of a brick of 5 cm is some 1e-4 m^2
/// of the mass that it moves.
double asymmetry(const Matrix& m) {
    const auto resisted = [&](std::size_t i) { return !(m[i][i] <= 1e-5 * m[0][0]); };
    if (!(m[0][0] > 0.0)) return std::numeric_limits<double>::quiet_NaN();  // the fluid resists nothing
    double worst = 0.0;
    for (std::size_t i = 0; i < m.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (resisted(i) && resisted(j))
                worst = worse(worst, std::abs(m[i][j] - m[j][i]) / std::sqrt(m[i][i] * m[j][j]));
    return worst;
}

Scene without_swings(Scene scene) {
    for (Scene::Body& body : scene.bodies) body.oscillation.reset();
    return scene;
}

/// Of the blows that set the bodies going.
std::vector<double> of_added_mass(Laboratory& lab, const Scene& scene) {
    Scene one = without_swings(scene);
    one.outputs.duration_s = one.solver.dt_s;
    return {asymmetry(matrix(lab, one))};
}

/// Of steady creeping flow around the brick alone.
std::vector<double> of_resistance(Laboratory& lab, const Scene& scene) {
    Scene one = without_swings(scene);
    one.bodies.erase(one.bodies.begin());
    for (Scene::Wall* wall : one.tank.walls.all()) wall->kind = WallKind::NoSlip;
    one.fluid.viscosity_pa_s = 1000.0;
    one.outputs.duration_s = 12.0 * one.solver.dt_s;
    return {asymmetry(matrix(lab, one))};
}

}  // namespace

std::vector<Case> reciprocity_cases() {
    const std::vector<Quantity> symmetric{{.name = "greatest |m_ij - m_ji| / sqrt(m_ii m_jj)",
                                           .source = "reciprocity",
                                           .limits = {{25, 1e-3}}}};
    return {at_both_presets({.name = "B8.13-inertia",
                             .title = "added masses of both bodies, all twelve ways to move",
                             .quantities = symmetric,
                             .measure = of_added_mass}),
            at_both_presets({.name = "B8.13-friction",
                             .title = "resistance of the brick in creeping flow, all six ways to move",
                             .quantities = symmetric,
                             .measure = of_resistance,
                             .quick = {}})};
}

}  // namespace eddy::accuracy
