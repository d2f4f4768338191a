#include "firmware/stability/random_scene.h"

#include <gtest/gtest.h>

#include <set>

namespace eddy::stability {
namespace {

TEST(RandomScene, IsTheSameForTheSameSeedAndAnotherForAnother) {
    EXPECT_EQ(random_scene(7), random_scene(7));
    Scene other = random_scene(8);
    other.title = random_scene(7).title;
    EXPECT_NE(random_scene(7), other);
}

TEST(RandomScene, MayBeWrittenToAFileAndComesBack) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const Scene scene = random_scene(seed);
        EXPECT_EQ(read_scene(print_scene(scene), "s.toml").scene, scene) << seed;
    }
}

// Else the fuzz would look into one corner only.
TEST(RandomScene, HasEveryEffectSometimes) {
    std::set<std::string> seen;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        const Scene s = random_scene(seed);
        const auto see = [&](bool has, const char* what) {
            if (has) seen.insert(what);
        };
        see(s.smoke.has_value(), "smoke");
        see(s.temperature.has_value(), "temperature");
        see(s.vorticity_confinement.has_value(), "confinement");
        see(s.forcing.has_value(), "forcing");
        see(s.fluid.viscosity_pa_s > 0.0, "viscosity");
        see(s.solver.time_order == 2, "second order");
        see(s.solver.preset == SolverPreset::Yang2009, "yang2009");
        for (const Scene::Wall* wall : s.tank.walls.all()) {
            see(wall->kind == WallKind::Inflow, "inflow");
            see(wall->kind == WallKind::Open, "open");
        }
        for (const Scene::Source& source : s.sources) see(source.velocity_m_s.has_value(), "jet");
        for (const Scene::Body& body : s.bodies) {
            see(body.motion == BodyMotion::Free, "free");
            see(body.oscillation.has_value(), "oscillation");
            seen.insert(std::to_string(static_cast<int>(body.shape)));
        }
    }
    EXPECT_EQ(seen.size(), 12u + 9u);
}

TEST(SimplerScenes, AreAllDifferentFromTheSceneAndEndSomewhere) {
    Scene scene = random_scene(3);
    for (int parts = 0; !simpler_scenes(scene).empty(); ++parts) {
        ASSERT_LT(parts, 100);
        for (const Scene& less : simpler_scenes(scene)) EXPECT_NE(less, scene);
        scene = simpler_scenes(scene).front();
    }
    EXPECT_TRUE(scene.bodies.empty());
    EXPECT_FALSE(scene.smoke || scene.temperature);
}

TEST(Shrink, LeavesOnlyWhatTheFaultNeeds) {
    std::uint64_t seed = 1;
    while (random_scene(seed).bodies.size() < 2 || !random_scene(seed).smoke) ++seed;
    const Scene smallest =
        shrink(random_scene(seed), [](const Scene& s) { return s.smoke && !s.bodies.empty(); });
    EXPECT_TRUE(smallest.smoke);
    ASSERT_EQ(smallest.bodies.size(), 1u);
    EXPECT_EQ(smallest.bodies[0].motion, BodyMotion::Fixed);
    EXPECT_TRUE(smallest.sources.empty());
    EXPECT_FALSE(smallest.temperature || smallest.forcing || smallest.vorticity_confinement);
    EXPECT_EQ(smallest.fluid.viscosity_pa_s, 0.0);
}

}  // namespace
}  // namespace eddy::stability
