#include <cmath>
#include <numbers>

#include "firmware/stability/case.h"
#include "firmware/stability/criteria.h"
#include "firmware/stability/rule.h"
#include "firmware/stability/scene_parts.h"

namespace eddy::stability {
namespace {

constexpr double kPi = std::numbers::pi;

/// 8: a plate of 0.3 cells in place of the ball, turned about z.
void plate(Scene& s, double angle_deg) {
    const double side = shortest_side_m(s);
    Scene::Body body = box("plate", 0.5 * s.tank.size_m, {0.3 * s.tank.cell_m(), 0.5 * side, 0.5 * side});
    body.angle_deg = angle_deg;
    ball(s) = body;
}

Case thin_plate(const char* name, const char* title, double angle_deg) {
    return {.number = 8,
            .name = name,
            .title = title,
            .provokes = "fluid leaks through what no cell sees, the force flickers",
            .wants = "the fluid gives back no more energy than it was given",
            .change =
                [angle_deg](Scene& s) {
                    plate(s, angle_deg);
                    ball(s).oscillation = swing({0.15 * shortest_side_m(s), 0.0, 0.0}, 0.5);
                },
            .complaint = gives_back_no_more(),
            .calm_share = 0.0,
            .calm_s = kCalmS};
}

/// 9: nearly or really nothing in the hand.
Case tiny(const char* name, const char* title, double radius_cells) {
    return {.number = 9,
            .name = name,
            .title = title,
            .provokes = "a stencil without a solid, 0 by 0 in the shares of faces",
            .change = [radius_cells](Scene& s) { ball(s).radius_m = radius_cells * s.tank.cell_m(); }};
}

/// 13: what the first body is said to do is not what it is seen to do.
Case liar(const char* name, const char* title, std::function<void(const Moment&, gles::BodyState&)> says) {
    return {.number = 13,
            .name = name,
            .title = title,
            .provokes = "a flux through the surface that nothing explains: energy from nowhere",
            .drive = Drive::Steps,
            .script = [](Moment& m) { m.hand_m = m.middle_m(); },
            .bodies =
                [says](const Moment& m, std::vector<gles::BodyState>& bodies) {
                    if (m.disturbs() && !bodies.empty()) says(m, bodies[0]);
                }};
}

}  // namespace

std::vector<Case> body_cases() {
    std::vector<Case> cases;
    cases.push_back(thin_plate("plate-broadside", "a plate of 0.3 cells swings flat side ahead", 0.0));
    cases.push_back(thin_plate("plate-edge-on", "a plate of 0.3 cells swings edge ahead", 90.0));
    cases.push_back({.number = 8,
                     .name = "plate-turning",
                     .title = "a plate of 0.3 cells turns slowly in a stream",
                     .provokes = "the force jumps when an edge passes a cell",
                     .wants = "from step to step the force changes by less than a quarter of its peak",
                     .when_red = "a plate thinner than a cell closes a layer of faces; as it turns it goes "
                                 "over from one layer to the next, and what it displaces there is met in one "
                                 "step. The hand is held to its slew limit",
                     .change =
                         [](Scene& s) {
                             plate(s, 0.0);
                             ball(s).spin_rad_s = {0.0, 0.0, 0.5};
                             stream_through(s, vector_of({0.1, 0.0, 0.0}));
                         },
                     .complaint = force_is_continuous(0, 0.25, 20),
                     .calm_share = 0.0,
                     .calm_s = kCalmS,
                     // The plate stands in a quarter of the stream.
                     .narrowing = [](const glm::ivec3&) { return 4.0 / 3.0; }});
    cases.push_back(tiny("fifth-of-a-cell", "the ball in the hand has a radius of a fifth of a cell", 0.2));
    cases.push_back(tiny("radius-0", "the ball in the hand has no radius", 0.0));
    cases.push_back(
        {.number = 12,
         .name = "cross-through",
         .title = "two balls touch, overlap, cross and part",
         .provokes = "solid that is counted twice, a pocket between the two",
         .wants = "the force on neither jumps by more than half its peak; both together take "
                  "what the fluid's momentum loses, to 1e-3 of the peak",
         .when_red = "where bodies overlap or all but touch, guard gap lets less through the slivers between "
                     "them than they displace: some of the fluid is lost there, and its momentum with it. "
                     "Forces stay bounded and do not jump",
         .change =
             [](Scene& s) {
                 s.outputs.force_methods = true;
                 const double radius = 0.15 * shortest_side_m(s), way = 0.25 * s.tank.size_m.x;
                 const glm::dvec3 middle = 0.5 * s.tank.size_m;
                 ball(s) = sphere("one", middle, radius);
                 ball(s).oscillation = swing({way, 0.0, 0.0}, 0.2, 0.5 * kPi);
                 s.bodies.push_back(sphere("other", middle + glm::dvec3(0.0, 0.5 * radius, 0.0), radius));
                 s.bodies.back().oscillation = swing({-way, 0.0, 0.0}, 0.2, 0.5 * kPi);
             },
         // 1e-3: the limit of B8.2, where no bodies meet.
         .complaint =
             all_of({forces_balance(1e-3), force_is_continuous(0, 0.5, 20), force_is_continuous(1, 0.5, 20)}),
         .remark = remark_on_balance(),
         .steps = 558,  // they end side by side
         .least_steps = 100,
         .calm_share = 0.0,
         .calm_s = kCalmS,
         // What two balls press out from between them at the last, half a cell apart.
         .narrowing =
             [](const glm::ivec3& n) {
                 return std::max(1.0, 0.15 * std::max({n.x, n.y, n.z}));
             }});
    cases.push_back(liar("spin-not-shown", "the ball stands still and is said to move at 0.5 m/s and spin",
                         [](const Moment&, gles::BodyState& ball) {
                             ball.velocity_m_s = {0.5, 0.0, 0.0};
                             ball.spin_rad_s = {0.0, 50.0, 0.0};
                         }));
    cases.push_back(liar("motion-not-said", "the ball swings in a stream and is said to stand still", {}));
    cases.back().bodies = [](const Moment& m, std::vector<gles::BodyState>& bodies) {
        const double t = running_down_s(m.time_s, m.calm_from_s - kRunDownS);
        if (!bodies.empty())
            bodies[0].centre_m.x += 0.2 * shortest_side_m(*m.scene) * std::sin(2.0 * kPi * t);
    };
    cases.back().change = [](Scene& s) { stream_through(s, vector_of({0.1, 0.0, 0.0})); };
    cases.back().calm_share = 0.0;
    cases.back().calm_s = kCalmS;
    // In truth the ball goes at 0.2 m/s, of which nobody is told.
    cases.back().narrowing = [](const glm::ivec3&) { return 2.0; };
    return cases;
}

}  // namespace eddy::stability
