#include "firmware/stability/ledger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "firmware/fluid_setup.h"

namespace eddy::stability {
namespace {

Scene scene_of(const std::string& more) {
    return read_scene(
               "[tank]\nsize_m = [1.0, 1.0, 1.0]\ncells = [8, 8, 8]\n[fluid]\ndensity_kg_m3 = 2.0\n" + more,
               "test.toml")
        .scene;
}

TEST(Ledger, JustifiesNothingWhereNothingActs) {
    const Scene scene = scene_of("");
    Ledger ledger(scene, fluid_setup(scene));
    ledger.add(0.1, 0.1, {}, {});
    EXPECT_EQ(ledger.justified().speed_m_s, 0.0);
    EXPECT_EQ(ledger.justified().work_j, 0.0);
}

TEST(Ledger, CountsTheWorkOfABodyAgainstItsLoad) {
    const Scene scene = scene_of("[[body]]\nradius_m = 0.1\ncentre_m = [0.5, 0.5, 0.5]\nmotion = \"held\"\n");
    Ledger ledger(scene, fluid_setup(scene));
    gles::BodyState moving;
    moving.velocity_m_s = {0.0, 3.0, 0.0};
    ledger.add(0.1, 0.1, {moving}, {{{0.0, -10.0, 0.0}, {}}});
    EXPECT_DOUBLE_EQ(ledger.justified().speed_m_s, 3.0);
    const double volume = 4.0 / 3.0 * std::numbers::pi * 1e-3;
    const double skin = 4.0 * std::numbers::pi * 1e-2 * 0.5 * 0.125;
    const double swept = volume;  // pi (0.1 m)^2 * 0.3 m would be more than there is of it
    EXPECT_NEAR(ledger.justified().work_j, 3.0 + 0.5 * 2.0 * 9.0 * (volume + 1.5 * 1.5 * skin + swept), 1e-9);
    // At rest again: what it displaces stands, the speed it once had remains on record.
    ledger.add(0.2, 0.1, {{}}, {{}});
    EXPECT_NEAR(ledger.justified().work_j, 3.0 + 0.5 * 2.0 * 9.0 * swept, 1e-9);
    EXPECT_DOUBLE_EQ(ledger.justified().speed_m_s, 3.0);
}

TEST(Ledger, ATeleportJustifiesNoMoreThanATankLengthAStep) {
    const Scene scene = scene_of("[[body]]\nradius_m = 0.1\ncentre_m = [0.5, 0.5, 0.5]\nmotion = \"held\"\n");
    Ledger ledger(scene, fluid_setup(scene));
    gles::BodyState far;
    far.velocity_m_s = {1e9, 0.0, 0.0};
    ledger.add(0.1, 0.1, {far}, {{{-1.0, 0.0, 0.0}, {}}});
    EXPECT_DOUBLE_EQ(ledger.justified().speed_m_s, 10.0);
    EXPECT_LT(ledger.justified().work_j, 1e3);
}

TEST(Ledger, WhatABodyTakesFromAStreamIsNotTakenFromTheTank) {
    const std::string body = "[[body]]\nradius_m = 0.1\ncentre_m = [0.5, 0.5, 0.5]\nmotion = \"held\"\n";
    const std::string jet =
        "[[source]]\ncentre_m = [0.2, 0.5, 0.5]\nradius_m = 0.1\nvelocity_m_s = [1.0, 0.0, 0.0]\n";
    gles::BodyState pushed;
    pushed.velocity_m_s = {0.5, 0.0, 0.0};
    double work_j[2];
    for (const bool blown : {false, true}) {
        const Scene scene = scene_of(blown ? jet + body : body);
        Ledger ledger(scene, fluid_setup(scene));
        ledger.add(0.1, 0.1, {pushed}, {{{1e3, 0.0, 0.0}, {}}});
        work_j[blown] = ledger.justified().work_j;
    }
    EXPECT_LT(work_j[false], 0.0);
    EXPECT_GT(work_j[true], 0.0);
}

TEST(Ledger, AFreeBodyCannotJustifyARunaway) {
    const Scene scene = scene_of(
        "gravity_m_s2 = [0.0, -10.0, 0.0]\n"
        "[[body]]\nradius_m = 0.1\ncentre_m = [0.5, 0.5, 0.5]\nmotion = \"free\"\ndensity_kg_m3 = 3.0\n");
    Ledger ledger(scene, fluid_setup(scene));
    gles::BodyState runaway;
    runaway.velocity_m_s = {100.0, 0.0, 0.0};
    ledger.add(0.1, 0.1, {runaway}, {{}});
    // (rho_b - rho) / (rho_b + rho / 2) = 1/4: falls through 1 m at sqrt(2 * 2.5)
    EXPECT_NEAR(ledger.justified().speed_m_s, std::sqrt(5.0), 1e-9);
}

TEST(Ledger, AddsUpWhatSourcesGive) {
    const Scene scene = scene_of(
        "[smoke]\n[temperature]\n[[source]]\ncentre_m = [0.5, 0.5, 0.5]\nradius_m = 0.1\nsmoke_per_s = 4.0\n"
        "temperature_k_per_s = -20.0\nstop_s = 0.2\n");
    Ledger ledger(scene, fluid_setup(scene));
    for (int i = 1; i <= 4; ++i) ledger.add(0.1 * i, 0.1, {}, {});
    EXPECT_NEAR(ledger.justified().smoke_added.high, 0.8, 1e-9);
    EXPECT_NEAR(ledger.justified().temperature_added_k.low, -4.0, 1e-9);
    EXPECT_EQ(ledger.justified().temperature_added_k.high, 0.0);
}

TEST(Ledger, ConfinementMaySpreadWhatIsThereAtTheStart) {
    const std::string wind = "[initial]\nvelocity_m_s = [\"3 * sin(3.14159265 * y)\", 0.0, 0.0]\n";
    for (const bool confined : {false, true}) {
        const Scene scene =
            scene_of((confined ? "[vorticity_confinement]\nstrength_1_s = 2.0\n" : "") + wind);
        Ledger ledger(scene, fluid_setup(scene));
        ledger.add(0.1, 0.1, {}, {});
        EXPECT_NEAR(ledger.justified().speed_m_s, 3.0, 1e-6);
        EXPECT_NEAR(ledger.justified().work_j, confined ? 0.5 * 2.0 * 9.0 : 0.0, 1e-6);
    }
}

/// A stream of 1 m/s in at x low and out at x high, in every cell, against a pressure of 3 Pa.
Fields stream() {
    return {std::vector<glm::vec3>(9 * 9 * 9, glm::vec3(1.0f, 0.0f, 0.0f)),
            std::vector<float>(8 * 8 * 8, 3.0f),
            {},
            {}};
}

TEST(Ledger, WhereFieldsAreSeenCountsWhatTheStreamReallyBringsIn) {
    const Scene scene = scene_of(
        "[tank.walls]\nx_low = { kind = \"inflow\", velocity_m_s = [1.0, 0.0, 0.0] }\nx_high = \"open\"\n");
    Ledger seen(scene, fluid_setup(scene), 4.0, Ledger::Inflow::Seen);
    seen.add(0.1, 0.1, {}, {});
    EXPECT_EQ(seen.justified().work_j, 0.0);
    seen.add_fields(0.1, stream());
    EXPECT_NEAR(seen.justified().work_j, 0.1 * (3.0 + 0.5 * 2.0), 1e-6);  // of 1 m2
    EXPECT_DOUBLE_EQ(seen.justified().speed_m_s, 1.0);
    Ledger estimated(scene, fluid_setup(scene), 4.0);
    estimated.add(0.1, 0.1, {}, {});
    EXPECT_GT(estimated.justified().work_j, 1.0) << "all of the tank may have been set going";
}

TEST(Ledger, WhereTheTankIsOpenItsFluidMayFall) {
    const Scene scene = scene_of("gravity_m_s2 = [0.0, -10.0, 0.0]\n[tank.walls]\ny_low = \"open\"\n");
    EXPECT_NEAR(Ledger(scene, fluid_setup(scene)).justified().speed_m_s, std::sqrt(20.0), 1e-9);
}

TEST(Ledger, BuoyancyJustifiesTheFallOfWhatIsHeavier) {
    const Scene scene =
        scene_of("gravity_m_s2 = [0.0, -10.0, 0.0]\n[smoke]\nweight = 0.1\ninitial = \"0.5 * y\"\n");
    Ledger ledger(scene, fluid_setup(scene));
    ledger.add(0.1, 0.1, {}, {});
    EXPECT_NEAR(ledger.justified().speed_m_s, std::sqrt(10.0 * 0.05 * 1.0), 1e-9);
    EXPECT_NEAR(ledger.justified().rest_speed_m_s, std::sqrt(10.0), 1e-9);
}

TEST(Ledger, LiftIsWhatBodiesFeelAtRest) {
    const Scene scene =
        scene_of("gravity_m_s2 = [0.0, -10.0, 0.0]\n[[body]]\nradius_m = 0.1\ncentre_m = [0.5, 0.5, 0.5]\n");
    const std::vector<gles::Load> loads = Ledger(scene, fluid_setup(scene)).at_rest();
    EXPECT_NEAR(loads.at(0).force_n.y, 2.0 * 4.0 / 3.0 * std::numbers::pi * 1e-3 * 10.0, 1e-9);
}

}  // namespace
}  // namespace eddy::stability
