#include "firmware/effects/effect.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace eddy::effects {
namespace {

EffectNames effects_in(const std::string& text) {
    return effects_of(read_scene(text, "test.toml").scene);
}

TEST(Effect, IsInTheSceneThatAsksForItAndInNoOther) {
    const std::string body = "[[body]]\nradius_m = 0.02\ncentre_m = [0.08, 0.08, 0.08]\n",
                      silent = "force = false\ntorque = false\n",
                      source = "[[source]]\ncentre_m = [0.08, 0.08, 0.08]\nradius_m = 0.02\n",
                      gravity = "[fluid]\ngravity_m_s2 = [0, -9.81, 0]\n";
    const std::pair<std::string, EffectNames> kScenes[] = {
        {"", {}},
        {body, {"bodies", "force", "torque"}},
        {body + silent, {"bodies"}},
        {body + "torque = false\n", {"bodies", "force"}},
        {body + silent + "motion = \"free\"\ndensity_kg_m3 = 1\n", {"bodies", "free bodies"}},
        {"[[body]]\nshape = \"box\"\nsize_m = [0.02, 0.03, 0.04]\nmotion = \"held\"\nturning = true\n" +
             silent,
         {"bodies", "free bodies"}},
        {"[tank]\nwalls = \"slip\"\n", {}},
        {"[tank]\nwalls = { y_low = \"no_slip\" }\n[fluid]\nviscosity_pa_s = 0.1\n",
         {"viscosity", "no-slip walls"}},
        {"[tank]\nwalls = { y_high = \"open\" }\n", {"open walls"}},
        {"[tank.walls]\nx_low = { kind = \"inflow\", velocity_m_s = [1, 0, 0] }\nx_high = \"open\"\n",
         {"open walls"}},
        {"[fluid]\nviscosity_pa_s = 0.1\n", {"viscosity"}},
        {gravity, {"gravity"}},
        {"[forcing]\nacceleration_m_s2 = [0, 1, 0]\n", {"forcing"}},
        {"[vorticity_confinement]\nstrength_1_s = 1\n", {"confinement"}},
        {"[vorticity_confinement]\nstrength_1_s = 0\n", {}},
        {source + "velocity_m_s = [1, 0, 0]\n", {"jets"}},
        {"[smoke]\n", {"smoke"}},
        {"[smoke]\ndissipation_1_s = 1\n", {"smoke", "smoke fading"}},
        {"[smoke]\n" + source + "smoke_per_s = 1\n", {"smoke", "smoke sources"}},
        {gravity + "[smoke]\nweight = 1\n", {"gravity", "smoke", "smoke weight"}},
        {"[temperature]\n", {"heat"}},
        {"[temperature]\ndiffusivity_m2_s = 1e-5\n", {"heat", "heat diffusion"}},
        {"[temperature]\n" + source + "temperature_k_per_s = 1\n", {"heat", "heat sources"}},
        {gravity + "[temperature]\nexpansion_1_k = 0.003\n", {"gravity", "heat", "heat lift"}},
        {"[solver]\npreset = \"precise\"\n", {"maccormack"}},
        {"[solver]\npreset = \"precise\"\nadvection = \"semi_lagrangian\"\n", {}},
        {"[solver]\nadvection = \"maccormack\"\n", {"maccormack"}},
        {"[solver]\ntime_order = 2\n", {"second order in time"}},
        {"[solver]\npreset = \"yang2009\"\n", {}},
    };
    EffectNames seen;
    for (const auto& [text, names] : kScenes) {
        EXPECT_EQ(effects_in(text), names) << text;
        seen.insert(names.begin(), names.end());
    }
    for (const Effect& effect : all_effects()) EXPECT_TRUE(seen.contains(effect.name)) << effect.name;
}

TEST(Effect, LeftOutIsGoneAndNothingElseIs) {
    for (const std::string name :
         {"everything", "float", "bench", "validation/A8-wide", "validation/A11", "validation/A17"}) {
        const Scene scene = load_scene(name).scene;
        const EffectNames all = effects_of(scene);
        for (const std::string_view effect : all) {
            const EffectNames rest = without(all, effect);
            EXPECT_FALSE(rest.contains(effect));
            EXPECT_EQ(effects_of(with_only(scene, rest)), rest) << name << " without " << effect;
        }
        EXPECT_EQ(with_only(scene, all), scene) << name;
        EXPECT_EQ(effects_of(with_only(scene, {})), EffectNames{}) << name;
    }
}

TEST(Effect, TakesAlongWhatNeedsIt) {
    const EffectNames all{"bodies", "force", "gravity", "smoke", "smoke sources", "smoke weight"};
    EXPECT_EQ(without(all, "smoke"), (EffectNames{"bodies", "force", "gravity"}));
    EXPECT_EQ(without(all, "gravity"), (EffectNames{"bodies", "force", "smoke", "smoke sources"}));
    EXPECT_EQ(without(all, "smoke weight"),
              (EffectNames{"bodies", "force", "gravity", "smoke", "smoke sources"}));
    EXPECT_EQ(without(all, "bodies"), (EffectNames{"gravity", "smoke", "smoke sources", "smoke weight"}));
    EXPECT_EQ(with_needs({"smoke weight"}), (EffectNames{"gravity", "smoke", "smoke weight"}));
    EXPECT_EQ(with_needs({"viscosity"}), (EffectNames{"viscosity"}));
}

TEST(Effect, LeavesASourceWhatElseItGives) {
    const Scene scene = load_scene("everything").scene;
    ASSERT_EQ(scene.sources.size(), 2u);
    const EffectNames all = effects_of(scene);
    const Scene no_jets = with_only(scene, without(all, "jets"));
    ASSERT_EQ(no_jets.sources.size(), 2u);
    EXPECT_FALSE(no_jets.sources[0].velocity_m_s);
    EXPECT_EQ(no_jets.sources[0].smoke_per_s, scene.sources[0].smoke_per_s);
    const Scene no_smoke = with_only(scene, without(all, "smoke"));
    EXPECT_EQ(no_smoke.sources.size(), 2u);
    EXPECT_EQ(with_only(no_smoke, without(effects_of(no_smoke), "heat")).sources.size(), 1u);
}

}  // namespace
}  // namespace eddy::effects
