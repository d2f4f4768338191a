#include "firmware/body_schedule.h"
#include "firmware/effects/effect.h"
#include "firmware/fluid_setup.h"
#include "firmware/plan.h"
#include "gles/fluid/fluid.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::effects {
namespace {

using EffectCost = gles::GlTest;

const std::vector<std::string> kSmall{"tank.cells=[16,16,16]"};

StepCost cost(const gles::Gpu& gpu, const Scene& scene) {
    gles::Gpu own(gpu.capabilities());
    return cost_of(own, fluid_setup(scene), BodySchedule(scene), scene.solver.dt_s);
}

/// Everything, and the effects that do not go with it.
std::vector<Scene> scenes_of_all_effects() {
    const std::vector<std::string> precise{kSmall[0], "solver.preset=\"precise\""};
    const std::vector<std::string> second{
        kSmall[0], "solver.time_order=2",
        "tank.walls={x_low={kind=\"inflow\",velocity_m_s=[\"sin(t)\",0,0]},x_high=\"open\"}"};
    return {load_scene("everything", precise).scene, load_scene("bench", second).scene};
}

TEST_F(EffectCost, IsInThePlanAndGoesWithTheEffect) {
    EffectNames seen;
    for (const Scene& scene : scenes_of_all_effects()) {
        const EffectNames all = effects_of(scene);
        seen.insert(all.begin(), all.end());
        const StepCost whole = cost(gpu, scene);
        for (const std::string_view effect : all) {
            const StepCost rest = cost(gpu, with_only(scene, without(all, effect)));
            // A tank that is closed instead has passes of its own, which keep its pressure and its energy in bounds.
            if (effect == "open walls") continue;
            EXPECT_LE(rest.work.passes, whole.work.passes) << effect;
            EXPECT_LE(rest.work.fetches, whole.work.fetches) << effect;
            EXPECT_LE(rest.texture_bytes, whole.texture_bytes) << effect;
            if (effect == "no-slip walls")  // other numbers in the same formula
                EXPECT_EQ(rest.work.uniforms, whole.work.uniforms);
            else if (effect == "maccormack")  // the same uniforms for a longer formula, twice
                EXPECT_LT(rest.work.passes, whole.work.passes);
            else
                EXPECT_LT(rest.work.uniforms, whole.work.uniforms) << effect;
        }
    }
    EXPECT_EQ(seen.size(), all_effects().size());
}

TEST_F(EffectCost, LeftOutIsThatOfASceneThatNeverHadIt) {
    const Scene scene = load_scene("everything", kSmall).scene;
    const std::pair<const char*, const char*> kChanges[] = {
        {"no-slip walls", "tank.walls=\"slip\""},
        {"heat lift", "temperature.expansion_1_k=0"},
        {"confinement", "vorticity_confinement.strength_1_s=0"},
    };
    for (const auto& [effect, change] : kChanges) {
        const std::vector<std::string> set{kSmall[0], change};
        const StepCost a = cost(gpu, with_only(scene, without(effects_of(scene), effect))),
                       b = cost(gpu, load_scene("everything", set).scene);
        EXPECT_EQ(a.work.passes, b.work.passes) << effect;
        EXPECT_EQ(a.work.uniforms, b.work.uniforms) << effect;
        EXPECT_EQ(a.work.fetches, b.work.fetches) << effect;
        EXPECT_EQ(a.work.bytes, b.work.bytes) << effect;
        EXPECT_EQ(a.textures, b.textures) << effect;
        EXPECT_EQ(a.texture_bytes, b.texture_bytes) << effect;
    }
}

std::vector<gles::Load> loads_of(gles::Gpu& gpu, const Scene& scene) {
    const BodySchedule motions(scene);
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, fluid_setup(scene));
    std::vector<gles::Load> loads;
    for (int n = 1; n <= 3; ++n) {
        fluid->step(scene.solver.dt_s, motions.at(n * scene.solver.dt_s, scene.solver.dt_s), false);
        loads = fluid->wait_result().loads;
    }
    return loads;
}

TEST_F(EffectCost, IsAllThatWeightlessSmokeAndHeatAndAnAskedForTorqueAdd) {
    // They are carried and push nothing: the force does not change by a bit.
    const Scene all = load_scene("everything", kSmall).scene;
    EffectNames kept = without(without(effects_of(all), "smoke weight"), "heat lift");
    const Scene scene = with_only(all, kept);
    const std::vector<gles::Load> before = loads_of(gpu, scene);
    ASSERT_EQ(before.size(), 2u);
    EXPECT_GT(glm::length(before[0].force_n), 0.0);
    for (const char* effect :
         {"smoke", "smoke sources", "smoke fading", "heat", "heat sources", "heat diffusion", "torque"}) {
        const std::vector<gles::Load> after = loads_of(gpu, with_only(scene, without(kept, effect)));
        for (std::size_t i = 0; i < before.size(); ++i) {
            EXPECT_EQ(after[i].force_n, before[i].force_n) << effect;
            if (std::string_view(effect) == "torque")
                EXPECT_EQ(after[i].torque_nm, glm::dvec3(0.0));
            else
                EXPECT_EQ(after[i].torque_nm, before[i].torque_nm) << effect;
        }
    }
}

}  // namespace
}  // namespace eddy::effects
