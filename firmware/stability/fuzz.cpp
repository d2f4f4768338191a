#include "firmware/stability/fuzz.h"

#include <fmt/format.h>

#include "firmware/body_schedule.h"
#include "firmware/fluid_setup.h"
#include "firmware/stability/field_work.h"
#include "firmware/stability/ledger.h"
#include "firmware/stability/random_scene.h"
#include "firmware/text_file.h"

namespace eddy::stability {

namespace {

/// Bodies anywhere may leave a gap of one cell for what a whole side of the tank pushes.
double narrowing(const gles::FluidSetup& setup) {
    return setup.bodies.empty() ? 1.0 : std::max({setup.cells.x, setup.cells.y, setup.cells.z});
}

}  // namespace

Violation first_violation(gles::Gpu& gpu, const Scene& scene, long steps) {
    const gles::FluidSetup setup = fluid_setup(scene);
    const BodySchedule motions(scene);
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, setup);
    const Tank tank = tank_of(setup);
    Ledger ledger(scene, setup, narrowing(setup));
    Rule rule(tank);
    rule.begin(download(*fluid));
    const double dt_s = scene.solver.dt_s;
    double field_work = 0.0;
    long step = 0;
    while (step < steps && !rule.failed()) {
        const double time_s = static_cast<double>(++step) * dt_s;
        fluid->step(dt_s, motions.at(time_s, dt_s), false);
        std::vector<gles::Load> loads;
        if (!scene.bodies.empty()) loads = fluid->wait_result().loads;
        const std::vector<gles::Load> at_rest = ledger.at_rest();
        for (std::size_t i = 0; i < loads.size(); ++i) loads[i].force_n -= at_rest[i].force_n;
        ledger.add(time_s, dt_s, fluid->bodies(), loads);
        const Fields fields = download(*fluid);
        Justified may = ledger.justified();
        may.speed_m_s = std::max(may.speed_m_s, falling_speed_m_s(setup));
        if (tank.staggered) field_work += field_work_j(setup, fields, dt_s);
        may.work_j += field_work;
        may.given_j += field_work;
        rule.see({.step = step, .time_s = time_s, .justified = may, .fields = &fields, .loads = loads});
    }
    return {rule.verdict().reason, step};
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
