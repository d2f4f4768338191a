#include "firmware/effects/study.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace eddy::effects {
namespace {

std::vector<std::string> names_of(const EffectStudy& study) {
    std::vector<std::string> names;
    for (const SceneVariant& variant : study.variants) names.push_back(variant.name);
    return names;
}

EffectStudy study_of(const std::string& text) {
    return study_effects(read_scene(text, "test.toml").scene);
}

const std::string kBody = "[[body]]\nradius_m = 0.02\ncentre_m = [0.08, 0.08, 0.08]\n";

TEST(EffectStudy, ComparesTheWholeWithEachLeftOutAndEachAloneWithTheBodies) {
    const EffectStudy study = study_of("[fluid]\ngravity_m_s2 = [0, -1, 0]\n[smoke]\nweight = 1\n" + kBody);
    EXPECT_THAT(
        names_of(study),
        testing::ElementsAre("whole scene", "bodies only", "without bodies", "without force",
                             "without torque", "without gravity", "without smoke", "without smoke weight",
                             "empty tank", "with force", "with torque", "with gravity", "with smoke",
                             "with gravity + smoke + smoke weight", "with gravity + smoke"));
    ASSERT_EQ(study.rows.size(), 6u);
    const auto name = [&](std::size_t variant) { return study.variants[variant].name; };
    const EffectStudy::Row &bodies = study.rows[0], &smoke = study.rows[4], &weight = study.rows[5];
    EXPECT_EQ(bodies.effect, "bodies");
    EXPECT_EQ(name(bodies.to_bare.with), "bodies only");
    EXPECT_EQ(name(bodies.to_bare.without), "empty tank");
    EXPECT_THAT(bodies.leaves_with_it, testing::ElementsAre("force", "torque"));
    EXPECT_EQ(name(smoke.to_whole.with), "whole scene");
    EXPECT_EQ(name(smoke.to_whole.without), "without smoke");
    EXPECT_EQ(name(smoke.to_bare.with), "with smoke");
    EXPECT_EQ(name(smoke.to_bare.without), "bodies only");
    EXPECT_THAT(smoke.leaves_with_it, testing::ElementsAre("smoke weight"));
    EXPECT_EQ(name(weight.to_bare.with), "with gravity + smoke + smoke weight");
    EXPECT_EQ(name(weight.to_bare.without), "with gravity + smoke");
    EXPECT_EQ(name(study.all_but_bodies.with), "whole scene");
    EXPECT_EQ(name(study.all_but_bodies.without), "bodies only");
}

TEST(EffectStudy, OfASceneWithoutBodiesStartsFromAnEmptyTank) {
    const EffectStudy study = study_of("[smoke]\n[fluid]\nviscosity_pa_s = 0.1\n");
    EXPECT_THAT(names_of(study),
                testing::ElementsAre("whole scene", "empty tank", "without viscosity", "without smoke"));
    EXPECT_EQ(study.variants[study.all_but_bodies.without].name, "empty tank");
    // Of two effects, one left out is the other alone: that is one variant, not two.
    EXPECT_EQ(study.rows[0].to_bare.with, study.rows[1].to_whole.without);
}

TEST(EffectStudy, OfEachShippedSceneHasEachVariantOnceAndWithTheEffectsItSays) {
    std::vector<std::string_view> scenes = shipped_scenes();
    for (const std::string_view name : validation_scenes()) scenes.push_back(name);
    for (const std::string_view name : scenes) {
        const Scene scene = load_scene(std::string(name)).scene;
        const EffectStudy study = study_effects(scene);
        EXPECT_EQ(study.variants[0].scene, scene) << name;
        EXPECT_EQ(study.rows.size(), effects_of(scene).size()) << name;
        for (std::size_t i = 0; i < study.variants.size(); ++i) {
            EXPECT_EQ(effects_of(study.variants[i].scene), study.variants[i].effects) << name;
            for (std::size_t j = 0; j < i; ++j) {
                EXPECT_NE(study.variants[i].effects, study.variants[j].effects) << name;
                EXPECT_NE(study.variants[i].name, study.variants[j].name) << name;
            }
        }
        for (const EffectStudy::Row& row : study.rows)
            for (const EffectAdded& added : {row.to_whole, row.to_bare}) {
                EXPECT_TRUE(study.variants[added.with].effects.contains(row.effect)) << name;
                EXPECT_FALSE(study.variants[added.without].effects.contains(row.effect)) << name;
            }
    }
}

}  // namespace
}  // namespace eddy::effects
