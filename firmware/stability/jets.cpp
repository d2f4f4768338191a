#include <fmt/format.h>

#include "firmware/stability/case.h"
#include "firmware/stability/criteria.h"
#include "firmware/stability/rule.h"
#include "firmware/stability/scene_parts.h"

namespace eddy::stability {
namespace {

void rest_in_the_middle(Moment& moment) {
    moment.hand_m = moment.middle_m();
}

const char* const kSlowJet =
    "what a slow jet leaves behind turns on for as long as friction in air lets it, minutes, and the ball "
    "feels that; "
    "the slower the jet, the larger a share of what it was. The force only falls";

/// 1: a jet that crosses so many cells in a step.
Case courant(double number) {
    return {.number = 1,
            .name = fmt::format("courant-{:g}", number),
            .title = fmt::format("a jet crosses {:g} cells in a step, around a ball", number),
            .provokes = "transport that overshoots: new extremes of smoke and of velocity",
            .wants = "transport makes no new extremes of any component of the velocity",
            .when_red = number < 1.0 ? kSlowJet : "",
            .change =
                [number](Scene& scene) {
                    Scene::Source& jet = scene.sources.emplace_back();
                    jet.name = "jet";
                    jet.centre_m = scene.tank.size_m * glm::dvec3(0.22, 0.5, 0.5);
                    jet.radius_m = 0.2 * shortest_side_m(scene);
                    jet.velocity_m_s = glm::dvec3(number * scene.tank.cell_m() / scene.solver.dt_s, 0.0, 0.0);
                },
            .script = rest_in_the_middle,
            .calm_share = 0.0,
            .calm_s = kCalmS,
            .watches_transport = true};
}

constexpr double kStream = 0.3;  // m/s, a draught

Case stream(const char* name, const char* title, const char* provokes, std::function<void(Scene&)> change) {
    return {.number = 19,
            .name = name,
            .title = title,
            .provokes = provokes,
            .wants = "as much flows out as in, to 1 %, as in case A17-precise of eddy accuracy",
            .when_red =
                "an inflow that begins or ends within a step has the whole tank follow in that step: "
                "more than the cycles of the least effort solve. What is left of it flows out in the "
                "steps after; energy and force stay within the rule",
            .change = std::move(change),
            .script = rest_in_the_middle,
            .complaint = volume_balances(1e-2),
            .calm_share = 0.0,
            .calm_s = kCalmS};
}

}  // namespace

std::vector<Case> jet_cases() {
    std::vector<Case> cases;
    for (const double number : {0.5, 1.0, 5.0, 20.0, 50.0}) cases.push_back(courant(number));
    cases.push_back(stream("inflow-100", "a hundred times the usual stream enters",
                           "speeds far beyond a cell a step", [](Scene& s) {
                               stream_through(s, vector_of({100.0 * kStream, 0.0, 0.0}));
                           }));
    cases.push_back(stream("inflow-20hz", "the stream is switched on and off twenty times a second",
                           "an impulse through the whole tank at each switch", [](Scene& s) {
                               stream_through(
                                   s, vector_of(Formula::parse("0.3 * (sin(125.66 * t) > 0)"), 0.0, 0.0));
                           }));
    cases.push_back(stream("jet-against-inflow", "a jet at the open wall blows against the stream",
                           "fluid enters where it should leave: back-flow through an open wall",
                           [](Scene& s) {
                               stream_through(s, vector_of({kStream, 0.0, 0.0}));
                               Scene::Source& jet = s.sources.emplace_back();
                               jet.name = "jet";
                               jet.centre_m = s.tank.size_m * glm::dvec3(0.85, 0.5, 0.5);
                               jet.radius_m = 0.15 * shortest_side_m(s);
                               jet.velocity_m_s = glm::dvec3(-1.0, 0.0, 0.0);
                           }));
    cases.push_back({.number = 20,
                     .name = "inflow-without-outflow",
                     .title = "a stream enters a tank that is closed everywhere else",
                     .provokes = "a pressure problem without solution: the pressure grows without end",
                     .wants = "the pressure stays bounded and does not drift",
                     .change =
                         [](Scene& s) {
                             s.tank.walls.x_low = {WallKind::Inflow, vector_of({0.1, 0.0, 0.0})};
                         },
                     .script = rest_in_the_middle,
                     .complaint = all_of({pressure_bounded(0.1), pressure_levels_off()}),
                     .least_steps = kLevelSteps,
                     .calm_share = 0.0,
                     .calm_s = kCalmS});
    return cases;
}

}  // namespace eddy::stability
