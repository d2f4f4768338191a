#include "config/scene_check.h"

#include <algorithm>

#include "config/scene_rules.h"

namespace eddy {

// What the solver does not do yet: one line each, deleted when it does.
void refuse_what_is_not_in_this_version(const Scene& scene, Findings& findings) {
    SceneRules rules(scene, findings);
    const auto not_in_this_version = [&](const std::string& key, bool used) {
        if (used) rules.blame(key, "not in this version of eddy");
    };
    const bool coupled = std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Scene::Body& body) {
        return body.motion == BodyMotion::Free || body.turning;
    });
    not_in_this_version("solver.time_order",
                        scene.solver.time_order != 1 &&
                            (coupled || scene.fluid.viscosity_pa_s != 0.0 || scene.outputs.force_methods));
}

void check(const Scene& scene, Findings& findings) {
    SceneRules rules(scene, findings);
    check_walls(rules);
    check_flow(rules);
    check_bodies(rules);
    check_outputs(rules);
}

}  // namespace eddy
