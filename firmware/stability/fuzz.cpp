#include "firmware/stability/fuzz.h"

#include <fmt/format.h>

#include <algorithm>

#include "firmware/stability/random_scene.h"
#include "firmware/stability/trial.h"
#include "firmware/text_file.h"

namespace eddy::stability {
namespace {

/// A scene as a case of its own: nothing happens but what it says, and a held body stays where it is.
Case as_case(const Scene& scene, long steps) {
    glm::dvec3 held_m(0.0);
    for (const Scene::Body& body : scene.bodies)
        if (body.motion == BodyMotion::Held) held_m = body.centre_m;
    return {.name = "scene",
            .drive = Drive::Steps,
            .change = [&scene](Scene& s) { s = scene; },
            .script = [held_m](Moment& m) { m.hand_m = held_m; },
            .ends_when_red = true,
            .looks_always = true,
            .steps = steps,
            .calm_share = 0.0,
            // Bodies anywhere may leave a gap of one cell for what a whole side of the tank pushes.
            .narrowing =
                [&scene](const glm::ivec3& n) {
                    return scene.bodies.empty() ? 1.0 : std::max({n.x, n.y, n.z});
                },
            .may_be_idle = true};
}

}  // namespace

Violation first_violation(gles::Gpu& gpu, const Scene& scene, long steps) {
    const Case one = as_case(scene, steps);
    const Case* const cases[] = {&one};
    const Outcome outcome = try_out(gpu, cases, {.cells = scene.tank.cells}, steps);
    return {outcome.verdict.reason, outcome.steps};
}

std::vector<FuzzFinding> fuzz(gles::Gpu& gpu, const FuzzPlan& plan,
                              const std::function<void(std::uint64_t seed)>& on_scene) {
    std::vector<FuzzFinding> findings;
    for (int i = 0; i < plan.scenes; ++i) {
        const std::uint64_t seed = plan.first_seed + static_cast<std::uint64_t>(i);
        if (on_scene) on_scene(seed);
        const Scene scene = random_scene(seed);
        const Violation violation = first_violation(gpu, scene, plan.steps);
        if (violation.reason.empty()) continue;
        // What is simpler may break a little later.
        const long steps = std::min(plan.steps, violation.step + 10);
        const Scene smallest = shrink(
            scene, [&](const Scene& less) { return !first_violation(gpu, less, steps).reason.empty(); });
        const std::filesystem::path file = plan.folder / fmt::format("fuzz-{}.toml", seed);
        replace_text_file(
            file, fmt::format("# Seed {}: {}\n# What is left of it: {}\n# eddy simulate {} --steps {}\n\n{}",
                              seed, violation.reason, first_violation(gpu, smallest, steps).reason,
                              file.filename().string(), plan.steps, print_scene(smallest)));
        findings.push_back({seed, violation.reason, file});
    }
    return findings;
}

}  // namespace eddy::stability
