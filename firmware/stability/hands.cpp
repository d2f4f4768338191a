#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "firmware/stability/case.h"
#include "firmware/stability/criteria.h"
#include "firmware/stability/scene_parts.h"

namespace eddy::stability {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// 4: every half second the hand is so many cells away at once, as far as the tank goes.
Case teleport(int cells) {
    return {.number = 4,
            .name = fmt::format("teleport-{}", cells),
            .title = fmt::format("twice a second the hand is {} cells away at once", cells),
            .provokes = "a wall velocity that no hand has, and the impulse of the added mass",
            .wants = "a quarter of a second after the last jump the force is below 2 % of its peak",
            .drive = Drive::Hand,
            .script =
                [cells](Moment& m) {
                    const bool away = m.disturbs() && m.step / 25 % 2 == 1;
                    const glm::dvec3 jump(away ? cells * m.cell_m() : 0.0, 0.0, 0.0);
                    m.hand_m = m.middle_m() + jump;
                },
            .complaint = force_recovers(0.25)};
}

/// 30: a hand that shakes along x.
Case shaking(const char* name, const char* title, std::function<double(const Moment&)> along_x_m) {
    return {.number = 30,
            .name = name,
            .title = title,
            .provokes = "the instability of the added mass, and motion too quick for the steps",
            .wants = "the fluid gives back no more energy than it was given",
            .script =
                [along_x_m](Moment& m) {
                    const double limit = 0.25 * shortest_side_m(*m.scene);
                    const double x = m.disturbs() ? along_x_m(m) : 0.0;
                    m.hand_m = m.middle_m() + glm::dvec3(std::clamp(x, -limit, limit), 0.0, 0.0);
                },
            .complaint = gives_back_no_more()};
}

/// Where a walk of 1 m/s that turns at random each step has come; it stays in the middle half of the tank.
glm::dvec3 walked_m(const Moment& m) {
    std::mt19937 random(30);
    std::normal_distribution<double> normal;
    const double limit = 0.25 * shortest_side_m(*m.scene), stride = m.scene->solver.dt_s;
    glm::dvec3 at(0.0);
    for (long i = 0; i <= m.step; ++i) {
        const glm::dvec3 way(normal(random), normal(random), normal(random));
        at = glm::clamp(at + stride * way / glm::length(way), glm::dvec3(-limit), glm::dvec3(limit));
    }
    return at;
}

}  // namespace

std::vector<Case> hand_cases() {
    std::vector<Case> cases;
    for (const int cells : {1, 5, 50}) cases.push_back(teleport(cells));
    cases.push_back({.number = 5,
                     .name = "through-wall",
                     .title = "the ball is pushed through a wall, is outside, and comes back",
                     .provokes = "cells without neighbours, boxes of cells that are empty or overflow",
                     .wants = "no force while it is outside, and on its way back the force rises without a "
                              "jump",
                     .drive = Drive::Steps,
                     .script =
                         [](Moment& m) {
                             const double length = m.scene->tank.size_m.x;
                             const double swing = std::sin(kTurn * 0.2 * (m.time_s + m.dt_s));
                             m.hand_m = m.middle_m() +
                                        glm::dvec3(m.disturbs() ? 1.3 * length * swing : 0.0, 0.0, 0.0);
                         },
                     .complaint = all_of({no_force_outside(), returns_smoothly()}),
                     .least_steps = 300});
    cases.push_back({.number = 5,
                     .name = "far-away",
                     .title = "the ball is said to be a kilometre, then 1e30 m, away",
                     .provokes = "integers of box arithmetic overflow",
                     .wants = "no force while it is outside",
                     .drive = Drive::Steps,
                     .script =
                         [](Moment& m) {
                             if (!m.disturbs() || m.step / 25 % 2 == 0)
                                 m.hand_m = m.middle_m();
                             else
                                 m.hand_m = glm::dvec3(m.step / 50 % 2 == 0 ? 1e3 : -1e30, 0.0, 0.0);
                         },
                     .complaint = no_force_outside(),
                     .least_steps = 200});
    cases.push_back({.number = 5,
                     .name = "hand-beyond",
                     .title = "the handle goes ten tank lengths beyond each wall in turn",
                     .provokes = "a body where its cells are not",
                     .drive = Drive::Hand,
                     .script =
                         [](Moment& m) {
                             glm::dvec3 away(0.0);
                             const int way = static_cast<int>(m.step / 20 % 6);
                             away[way / 2] = (way % 2 == 0 ? 10.0 : -10.0) * m.scene->tank.size_m.x;
                             m.hand_m = m.middle_m() + (m.disturbs() ? away : glm::dvec3(0.0));
                         },
                     .least_steps = 240});
    cases.push_back(shaking("cell-and-back", "the ball is a cell further in every other step",
                            [](const Moment& m) { return m.step % 2 == 0 ? m.cell_m() : 0.0; }));
    cases.push_back(shaking("there-and-back", "the ball is 30 mm further in every other step",
                            [](const Moment& m) { return m.step % 2 == 0 ? 0.015 : -0.015; }));
    cases.push_back(
        shaking("tremor-15hz", "the ball shakes by 30 mm fifteen times a second",
                [](const Moment& m) { return 0.015 * std::sin(kTurn * 15.0 * (m.time_s + m.dt_s)); }));
    cases.push_back(shaking("random-walk", "the hand walks at 1 m/s and turns at random each step", {}));
    cases.back().script = [](Moment& m) {
        m.hand_m = m.middle_m() + (m.disturbs() ? walked_m(m) : glm::dvec3(0.0));
    };
    cases.push_back({.number = 34,
                     .name = "late-answers",
                     .title = "three of four answers of the fluid do not come back in time",
                     .provokes = "a force that is stale, or a loop that waits",
                     .drive = Drive::Hand,
                     .script = [](Moment& m) { m.holds_answer = m.disturbs() && m.step % 4 != 3; }});
    cases.push_back({.number = 34,
                     .name = "no-answer",
                     .title = "the fluid does not answer for a second, again and again",
                     .provokes = "the last force is held for ever",
                     .wants = "the hand's force is 0 within 100 ms of when the first missing answer was due",
                     .drive = Drive::Hand,
                     .script = [](Moment& m) { m.holds_answer = m.disturbs() && m.step % 120 >= 70; },
                     .complaint = hand_let_go(0.1),
                     .least_steps = 240});
    return cases;
}

}  // namespace eddy::stability
