#include <cmath>
#include <numbers>

#include "firmware/stability/case.h"
#include "firmware/stability/criteria.h"
#include "firmware/stability/rule.h"
#include "firmware/stability/scene_parts.h"

namespace eddy::stability {
namespace {

constexpr double kQuarter = 0.5 * std::numbers::pi;
constexpr double kStream = 0.1;  // m/s

Criterion pressure_holds(double speed_m_s) {
    return all_of({pressure_bounded(speed_m_s), pressure_levels_off_or_is_small(speed_m_s)});
}

/// 6: a box before the wall where the stream enters, as wide as this share of the tank, that comes down on it.
Case cover(const char* name, const char* title, double share) {
    return {
        .number = 6,
        .name = name,
        .title = title,
        .provokes = "what flows in has nowhere to go: no pressure solves it",
        .wants = "the pressure stays bounded, and does not drift unless it is small",
        .when_red =
            "what flows in behind a lid that closes the tank has nowhere to go; no incompressible flow "
            "does that, and no pressure is enough. Guard pocket bounds the pressure, so the force on "
            "the lid ends; what the solver cannot place moves the fluid before the lid, faster than "
            "it flows in",
        .change =
            [share](Scene& s) {
                stream_through(s, vector_of({kStream, 0.0, 0.0}));
                const glm::dvec3& size = s.tank.size_m;
                const double thick = 0.3 * size.x, way = 0.15 * size.x;
                Scene::Body lid = box("lid", {way + 0.25 * thick, 0.5 * size.y, 0.5 * size.z},
                                      {thick, share * size.y, share * size.z});
                lid.oscillation = swing({way, 0.0, 0.0}, 0.2, kQuarter);
                ball(s) = lid;
            },
        .complaint = pressure_holds(kStream + 0.2 * 2.0 * std::numbers::pi * 0.15 * 0.16),
        .steps = 625,  // it ends as far down as it comes
        .least_steps = kLevelSteps,
        .calm_share = 0.0,
        .calm_s = kCalmS,
        // What comes in below a lid of s L goes out at its edge, through half a cell at the last; and the stream goes
        // through what it leaves open.
        .narrowing =
            [share](const glm::ivec3& n) {
                const double below = 0.5 * share * std::max({n.x, n.y, n.z});
                return share < 1.0 ? std::max(below, 1.0 / (1.0 - share * share)) : 1.0;
            }};
}

/// 7: walls, roof and piston of a cup that stands upside down on the floor.
void cup(Scene& s) {
    const glm::dvec3& size = s.tank.size_m;
    const double side = shortest_side_m(s), wide = 0.6 * side, thick = 0.12 * side, high = 0.5 * side;
    const glm::dvec3 foot(0.5 * size.x, 0.0, 0.5 * size.z);
    s.bodies.clear();
    const auto wall = [&](const char* name, double x, double z, const glm::dvec3& of) {
        Scene::Body body = box(name, foot + glm::dvec3(x, 0.5 * high, z), of);
        body.oscillation = swing({0.0, 0.3 * side, 0.0}, 0.2, kQuarter);
        body.centre_m.y += 0.3 * side - 0.02 * side;
        return body;
    };
    const double off = 0.5 * (wide - thick);
    s.bodies.push_back(wall("left", -off, 0.0, {thick, high, wide}));
    s.bodies.push_back(wall("right", off, 0.0, {thick, high, wide}));
    s.bodies.push_back(wall("back", 0.0, -off, {wide, high, thick}));
    s.bodies.push_back(wall("front", 0.0, off, {wide, high, thick}));
    Scene::Body roof = wall("roof", 0.0, 0.0, {wide, thick, wide});
    roof.centre_m.y += 0.5 * (high - thick);
    s.bodies.push_back(roof);
}

}  // namespace

std::vector<Case> wall_cases() {
    std::vector<Case> cases;
    cases.push_back(cover("covers-part", "a lid comes down on part of the inflow", 0.6));
    cases.push_back(cover("covers-all", "a lid comes down on all of the inflow", 1.2));
    cases.push_back(
        {.number = 7,
         .name = "piston",
         .title = "a piston in a closed tube squeezes what is before it",
         .provokes = "a pocket of its own: one more constant in its pressure, and no solution",
         .wants = "the pressure stays bounded, and does not drift unless it is small",
         .when_red = "what a piston displaces in a closed tube has nowhere to go, and no incompressible flow "
                     "does that. "
                     "Guard pocket bounds the pressure; what the solver cannot place it leaves in the layer "
                     "before the "
                     "piston, from where the fluid flows off to the whole pocket, at some five times the "
                     "piston's speed "
                     "where its face lies within a cell. Energy stays within the rule. Guard pocket_level "
                     "ends the push "
                     "on a piston that has stopped; the hand is held to its limits",
         .change =
             [](Scene& s) {
                 const glm::dvec3& size = s.tank.size_m;
                 Scene::Body piston = box("piston", 0.5 * size, {0.25 * size.x, 1.2 * size.y, 1.2 * size.z});
                 piston.oscillation = swing({0.15 * size.x, 0.0, 0.0}, 0.5);
                 ball(s) = piston;
             },
         .complaint = pressure_holds(std::numbers::pi * 0.15 * 0.16),
         .least_steps = kLevelSteps,
         .calm_share = 0.0,
         .calm_s = kCalmS});
    cases.push_back(
        {.number = 7,
         .name = "cup",
         .title = "a cup comes down on the floor, and is pressed into it",
         .provokes = "a pocket that comes and goes, walls thinner than cells",
         .wants = "the pressure stays bounded, and does not drift unless it is small",
         .change = cup,
         .complaint = pressure_holds(0.4 * std::numbers::pi * 0.3 * 0.16),
         .steps = 625,  // it ends on the floor
         .least_steps = kLevelSteps,
         .calm_share = 0.0,
         .calm_s = kCalmS,
         // Out of the cup, 0.5 by 0.36^2 of its side, through a slit as low as a cell's tenth: no more than this
         // is resolved.
         .narrowing = [](const glm::ivec3&) { return 4.0; }});
    cases.push_back({.number = 10,
                     .name = "fills-the-tank",
                     .title = "a box fills the tank but for 0.4 cells at each wall, and shakes",
                     .provokes = "a nearly singular system, a force without measure",
                     .wants = "the fluid gives back no more energy than it was given",
                     .change =
                         [](Scene& s) {
                             const double gap = 0.4 * s.tank.cell_m();
                             Scene::Body filler =
                                 box("filler", 0.5 * s.tank.size_m, s.tank.size_m - 2.0 * gap);
                             filler.oscillation = swing({0.3 * s.tank.cell_m(), 0.0, 0.0}, 1.0);
                             ball(s) = filler;
                         },
                     .complaint = gives_back_no_more(),
                     .calm_share = 0.0,
                     .calm_s = kCalmS,
                     // What one end displaces, L^2, goes through the slit around it, 4 L times 0.4 cells.
                     .narrowing =
                         [](const glm::ivec3& n) {
                             return std::max({n.x, n.y, n.z}) / 1.6;
                         }});
    cases.push_back({.number = 11,
                     .name = "corner",
                     .title = "a ball that touches three walls vibrates at 10 Hz",
                     .provokes = "conditions of walls and body that contradict each other in the same cells",
                     .wants = "beside the motion's own lines the force has none above 5 % of them",
                     .change =
                         [](Scene& s) {
                             s.solver.dt_s = 0.005;
                             const double radius = 0.2 * shortest_side_m(s);
                             ball(s) = sphere("ball", glm::dvec3(radius), radius);
                             ball(s).oscillation = swing(glm::dvec3(0.5 * s.tank.cell_m()), 10.0);
                         },
                     .complaint = no_other_lines(10.0),
                     .least_steps = 160,  // four periods of what has settled
                     .calm_share = 0.0,
                     .calm_s = kCalmS});
    return cases;
}

}  // namespace eddy::stability
