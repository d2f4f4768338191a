#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/config/complaints.h"
#include "tests/config/whole_schema.h"

namespace eddy {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

const std::string kWater = "[fluid]\nviscosity_pa_s = 0.001\n";
const std::string kEarth = "[fluid]\ngravity_m_s2 = [0, -9.81, 0]\n";

std::string walls(const std::string& keys) {
    return "[tank.walls]\n" + keys + "\n";
}

TEST(WallRules, AWordIsShortForATable) {
    const Scene s = read_whole(kWater + walls("x_low = \"no_slip\"\nx_high = { kind = \"no_slip\" }")).scene;
    EXPECT_EQ(s.tank.walls.x_low, s.tank.walls.x_high);
    EXPECT_EQ(s.tank.walls.x_low.kind, WallKind::NoSlip);
    EXPECT_EQ(s.tank.walls.y_low.kind, WallKind::Slip);
    const Scene all = read_whole(kWater + "[tank]\nwalls = \"no_slip\"\n").scene;
    EXPECT_EQ(all.tank.walls.z_high.kind, WallKind::NoSlip);
}

TEST(WallRules, ASideIsAWordOrATable) {
    EXPECT_THAT(faults_of(walls("x_low = 3")),
                ElementsAre("s.toml:2:9: tank.walls.x_low: expected a table, or one of the words \"slip\", "
                            "\"no_slip\", \"inflow\", \"open\", found the whole number 3"));
    EXPECT_THAT(faults_of(walls("x_low = { kin = \"slip\" }")),
                ElementsAre("s.toml:2:11: tank.walls.x_low.kin: unknown key; nearest valid key: kind"));
}

TEST(WallRules, InflowNeedsAVelocity) {
    EXPECT_THAT(
        faults_of(walls("x_low = \"inflow\"\nx_high = \"open\"")),
        ElementsAre(StartsWith("s.toml:2:9: tank.walls.x_low.velocity_m_s: is missing here: write x_low = "
                               "{ kind = \"inflow\", velocity_m_s = ")));
}

TEST(WallRules, SlipAndOpenHaveNoVelocity) {
    EXPECT_THAT(
        faults_of(walls("y_low = { velocity_m_s = [1, 0, 0] }")),
        ElementsAre("s.toml:2:26: tank.walls.y_low.velocity_m_s: is for no_slip and inflow, but kind is "
                    "\"slip\""));
    EXPECT_THAT(faults_of(walls("y_low = { kind = \"open\", velocity_m_s = [1, 0, 0] }")),
                ElementsAre(StartsWith("s.toml:2:41: tank.walls.y_low.velocity_m_s: is for")));
}

TEST(WallRules, ANoSlipWallMovesAlongItself) {
    EXPECT_THAT(
        faults_of(kWater + walls("y_high = { kind = \"no_slip\", velocity_m_s = [\"sin(t)\", \"0\", 1] }")),
        IsEmpty());
    EXPECT_THAT(faults_of(kWater + walls("y_high = { kind = \"no_slip\", velocity_m_s = [0, \"x\", 0] }")),
                ElementsAre(StartsWith("s.toml:4:45: tank.walls.y_high.velocity_m_s.1: must be 0")));
}

TEST(WallRules, NoSlipNeedsViscosity) {
    EXPECT_THAT(faults_of("[tank]\nwalls = \"no_slip\"\n"),
                ElementsAre(StartsWith("s.toml:2:9: tank.walls.x_low: an inviscid fluid does not stick")));
}

TEST(WallRules, WhatFlowsIntoAClosedBoxIsRefused) {
    const std::string inflow = "x_low = { kind = \"inflow\", velocity_m_s = [0.1, 0, 0] }\n";
    EXPECT_THAT(
        faults_of(walls(inflow)),
        ElementsAre(StartsWith("s.toml:2:9: tank.walls.x_low: what flows into a closed box cannot leave it: "
                               "make a wall \"open\"")));
    EXPECT_THAT(faults_of(walls(inflow + "z_low = \"open\"")), IsEmpty());
}

TEST(WallRules, InflowsThatBalanceNeedNoOpenWall) {
    const std::string in = "x_low = { kind = \"inflow\", velocity_m_s = [\"y * t\", 0, 0] }\n";
    EXPECT_THAT(faults_of(walls(in + "x_high = { kind = \"inflow\", velocity_m_s = [\"y * t\", 0, 0] }")),
                IsEmpty());
    EXPECT_THAT(faults_of(walls(in + "y_high = { kind = \"inflow\", velocity_m_s = [0, \"x * t\", 0] }")),
                IsEmpty());
    EXPECT_THAT(faults_of(walls(in + "x_high = { kind = \"inflow\", velocity_m_s = [\"y * t^2\", 0, 0] }")),
                ElementsAre(StartsWith("s.toml:2:9: tank.walls.x_low: what flows into a closed box")));
}

TEST(FormulaKeys, TakeNumbersAndTexts) {
    const Scene s = read_whole("[initial]\nvelocity_m_s = [1, \"2 * x\", 0.5]\n").scene;
    EXPECT_EQ(s.initial.velocity_m_s.evaluate({3, 0, 0}, 0), glm::dvec3(1, 6, 0.5));
}

TEST(FormulaKeys, FaultsPointAtTheValueAndIntoTheText) {
    EXPECT_THAT(
        faults_of("[initial]\nvelocity_m_s = [1, \"2 * xx\", 0]\n"),
        ElementsAre("s.toml:2:20: initial.velocity_m_s.1: no good formula, at its character 5: unknown name "
                    "\"xx\"; nearest: x"));
    EXPECT_THAT(faults_of("[smoke]\ninitial = true\n"),
                ElementsAre("s.toml:2:11: smoke.initial: expected a number or a formula, found true"));
    EXPECT_THAT(faults_of("[smoke]\ninitial = \"-log(0)\"\n"),
                ElementsAre("s.toml:2:11: smoke.initial: inf is not a finite number"));
}

TEST(EffectRules, WeightAndExpansionNeedGravity) {
    EXPECT_THAT(faults_of("[smoke]\nweight = -1\n"),
                ElementsAre(StartsWith("s.toml:2:10: smoke.weight: does nothing without gravity")));
    EXPECT_THAT(
        faults_of("[temperature]\nexpansion_1_k = 1e-3\n"),
        ElementsAre(StartsWith("s.toml:2:17: temperature.expansion_1_k: does nothing without gravity")));
    EXPECT_THAT(faults_of(kEarth + "[smoke]\nweight = -1\n[temperature]\nexpansion_1_k = 1e-3\n"), IsEmpty());
}

TEST(EffectRules, HeatSourcesNeedTheTemperature) {
    const std::string heater =
        "[[source]]\ncentre_m = [0.1, 0.1, 0.1]\nradius_m = 0.01\ntemperature_k_per_s = 1\n";
    EXPECT_THAT(
        faults_of(heater),
        ElementsAre(StartsWith("s.toml:4:23: source.0.temperature_k_per_s: needs the temperature effect")));
    EXPECT_THAT(faults_of(heater + "[temperature]\n"), IsEmpty());
}

TEST(InitialRules, TheFlowStartsFromAFormulaOrAFile) {
    EXPECT_THAT(faults_of("[initial]\nvelocity_npy = \"nowhere.npy\"\n"),
                ElementsAre(StartsWith("s.toml:2:16: initial.velocity_npy: there is no file \"/")));
    const std::string file = testing::TempDir() + "eddy_initial.npy";
    std::ofstream(file) << "\n";
    const std::string initial = "[initial]\nvelocity_npy = \"" + file + "\"\n";
    EXPECT_THAT(faults_of(initial), IsEmpty());
    EXPECT_THAT(
        faults_of(initial + "velocity_m_s = [0, 0, \"x\"]\n"),
        ElementsAre(StartsWith("s.toml:2:16: initial.velocity_npy: takes the place of velocity_m_s")));
}

TEST(ImposedRules, WhatPushesTheFlowIsRefused) {
    const std::string imposed = "[imposed]\nvelocity_m_s = [0, 0, 1]\n";
    EXPECT_THAT(faults_of(imposed + "[smoke]\n"), IsEmpty());
    EXPECT_THAT(
        faults_of(imposed + kBody),
        ElementsAre("s.toml:3:1: body.0: does nothing in an imposed flow: remove this, or [imposed]"));
    EXPECT_THAT(faults_of(imposed + kWater), ElementsAre(StartsWith("s.toml:4:18: fluid.viscosity_pa_s: ")));
    EXPECT_THAT(faults_of(imposed + kEarth), ElementsAre(StartsWith("s.toml:4:16: fluid.gravity_m_s2: ")));
    EXPECT_THAT(faults_of(imposed + "[forcing]\nacceleration_m_s2 = [1, 0, 0]\n"),
                ElementsAre(StartsWith("s.toml:3:1: forcing: ")));
    EXPECT_THAT(faults_of(imposed + "[vorticity_confinement]\nstrength_1_s = 1\n"),
                ElementsAre(StartsWith("s.toml:3:1: vorticity_confinement: ")));
    EXPECT_THAT(faults_of(imposed + "[initial]\nvelocity_m_s = [1, 0, 0]\n"),
                ElementsAre(StartsWith("s.toml:4:16: initial.velocity_m_s: ")));
    EXPECT_THAT(faults_of(imposed + walls("x_low = \"open\"")),
                ElementsAre(StartsWith("s.toml:3:1: tank.walls: ")));
    EXPECT_THAT(faults_of(imposed + "[[source]]\ncentre_m = [0.1, 0.1, 0.1]\nradius_m = 0.01\n"
                                    "velocity_m_s = [1, 0, 0]\n"),
                ElementsAre(StartsWith("s.toml:6:16: source.0.velocity_m_s: ")));
}

TEST(SolverRules, KeysBelongToTheirPreset) {
    const std::string yang = "[solver]\npreset = \"yang2009\"\n";
    EXPECT_THAT(faults_of(yang + "force_sum = \"cpu\"\njacobi_sweeps = 50\n"), IsEmpty());
    EXPECT_THAT(
        faults_of("[solver]\nforce_sum = \"cpu\"\n"),
        ElementsAre("s.toml:2:13: solver.force_sum: is for preset = \"yang2009\", but preset is \"fast\""));
    EXPECT_THAT(faults_of(yang + "advection = \"maccormack\"\n"),
                ElementsAre(StartsWith("s.toml:3:13: solver.advection: is not in the method of Yang")));
    EXPECT_THAT(faults_of(yang + "time_order = 2\n"),
                ElementsAre(StartsWith("s.toml:3:14: solver.time_order: is not in the method of Yang")));
    EXPECT_THAT(faults_of(yang + "[temperature]\n"),
                ElementsAre(StartsWith("s.toml:3:1: temperature: is not in the method of Yang")));
    EXPECT_THAT(faults_of(yang + "viscous_cycles = 2\n" + kWater),
                ElementsAre(StartsWith("s.toml:3:18: solver.viscous_cycles: is not in the method of Yang")));
    EXPECT_THAT(faults_of("[solver]\ntime_order = 3\n"),
                ElementsAre(StartsWith("s.toml:2:14: solver.time_order: 3 is out of range")));
}

TEST(SolverRules, ViscousCyclesNeedViscosity) {
    EXPECT_THAT(
        faults_of("[solver]\nviscous_cycles = 2\n"),
        ElementsAre(StartsWith("s.toml:2:18: solver.viscous_cycles: does nothing in an inviscid fluid")));
    EXPECT_THAT(faults_of("[solver]\nviscous_cycles = 2\n" + kWater), IsEmpty());
}

}  // namespace
}  // namespace eddy
