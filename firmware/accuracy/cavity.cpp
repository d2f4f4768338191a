#include <cmath>

#include "firmware/accuracy/case.h"

// A11  A cube whose lid y = L slides along x, Re = U L / nu = 100: u on the vertical and v on the horizontal line through
//      the middle of the cube.

namespace eddy::accuracy {
namespace {

struct Point {
    double place;  // on the line, in units of L
    double value;  // in units of U
};

// A second-order staggered scheme with a direct pressure solver, at 48 and 64 cells and extrapolated; +-0.0005.
constexpr Point kU[] = {{.0625, -.0453}, {.125, -.0822}, {.1875, -.1153}, {.25, -.1466}, {.375, -.1994},
                        {.5, -.2135},    {.625, -.1592}, {.75, -.0289},   {.875, .2574}, {.9375, .5641}};
constexpr Point kV[] = {{.0625, .0878}, {.125, .1356},  {.1875, .1525}, {.25, .1479},   {.375, .0991},
                        {.5, .0131},    {.625, -.1071}, {.75, -.2282},  {.875, -.2144}, {.9375, -.1224}};

/// Component k at a place of the tank [m], linear between the faces around it.
double between_faces(const FaceVelocity& u, const glm::dvec3& place_m, int k) {
    glm::dvec3 s = place_m / u.cell_m() - 0.5;
    s[k] += 0.5;
    const glm::ivec3 low(glm::floor(s));
    const glm::dvec3 f = s - glm::dvec3(low);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 e(corner & 1, (corner >> 1) & 1, corner >> 2);
        const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(e));
        sum += w.x * w.y * w.z * u.at(low + e, k);
    }
    return sum;
}

std::vector<double> profiles(Laboratory& lab) {
    Run run = lab.start();
    run.step_to_end();
    const FaceVelocity u = run.velocity();
    const double length = lab.scene().tank.size_m.x;
    const double speed = lab.scene().tank.walls.y_high.velocity_m_s->evaluate({}, 0.0).x;
    double sum = 0.0;
    for (const Point& p : kU)
        sum += std::pow(between_faces(u, length * glm::dvec3(0.5, p.place, 0.5), 0) / speed - p.value, 2);
    for (const Point& p : kV)
        sum += std::pow(between_faces(u, length * glm::dvec3(p.place, 0.5, 0.5), 1) / speed - p.value, 2);
    return {std::sqrt(sum / static_cast<double>(std::size(kU) + std::size(kV)))};
}

}  // namespace

std::vector<Case> cavity_cases() {
    return {
        {.name = "A11",
         .title = "lid-driven cavity at Re 100",
         .scene = "validation/A11",
         .time_step = TimeStep::Courant,
         .quick = {16, 32},
         .full = {16, 32, 64},
         .quantities =
             {{.name = "rms error / U",
               .source = "second-order staggered scheme, 48 and 64 cells extrapolated, +-0.0005; 20 points",
               .limits = {{32, 0.01}}}},
         .measure = profiles}};
}

}  // namespace eddy::accuracy
