#include "firmware/fluid_setup.h"

#include <gmock/gmock.h>

#include <limits>
#include <numeric>

#include "firmware/input_error.h"
#include "firmware/npy.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

gles::FluidSetup setup_of(const std::string& scene) {
    return fluid_setup(read_scene(scene, "test.toml").scene);
}

TEST(FluidSetup, OfEachPresetIsWhatItsNameSays) {
    const gles::SolverSetup fast = setup_of("[solver]\npreset = \"fast\"\n").solver;
    EXPECT_EQ(fast.method, gles::Method::CutCell);
    EXPECT_EQ(fast.advection, gles::Advection::SemiLagrangian);
    EXPECT_EQ(fast.cycles, 2);
    const gles::SolverSetup precise = setup_of("[solver]\npreset = \"precise\"\n").solver;
    EXPECT_EQ(precise.method, gles::Method::CutCell);
    EXPECT_EQ(precise.advection, gles::Advection::MacCormack);
    EXPECT_EQ(precise.cycles, 3);
    const gles::SolverSetup yang = setup_of("[solver]\npreset = \"yang2009\"\n").solver;
    EXPECT_EQ(yang.method, gles::Method::Yang2009);
    EXPECT_EQ(yang.jacobi_sweeps, 40);
}

TEST(FluidSetup, MeasuresTheForceInMoreWaysWhereTheSceneAsksForIt) {
    const std::string ball =
        "[[body]]\nradius_m = 0.02\ncentre_m = [0.08, 0.08, 0.08]\n[outputs]\nforce_methods = ";
    EXPECT_TRUE(setup_of(ball + "true\n").force_methods);
    EXPECT_FALSE(setup_of(ball + "false\n").force_methods);
}

TEST(FluidSetup, TakesWhatTheSceneStatesOverThePreset) {
    const gles::SolverSetup s =
        setup_of("[solver]\npreset = \"precise\"\nadvection = \"semi_lagrangian\"\ncycles = 7\n").solver;
    EXPECT_EQ(s.advection, gles::Advection::SemiLagrangian);
    EXPECT_EQ(s.cycles, 7);
    EXPECT_EQ(setup_of("[solver]\nadvection = \"maccormack\"\n").solver.advection,
              gles::Advection::MacCormack);
    EXPECT_EQ(setup_of("[solver]\npreset = \"yang2009\"\njacobi_sweeps = 12\n").solver.jacobi_sweeps, 12);
}

TEST(FluidSetup, HasOnlyTheEffectsTheSceneNames) {
    const gles::FluidSetup nothing = setup_of("");
    EXPECT_FALSE(nothing.smoke);
    EXPECT_TRUE(nothing.bodies.empty());
    EXPECT_TRUE(nothing.sources.empty());
    EXPECT_EQ(setup_of("[smoke]\ndissipation_1_s = 0.5\n").smoke->dissipation_1_s, 0.5);
}

TEST(FluidSetup, CarriesTankSourcesAndBodiesOver) {
    const gles::FluidSetup s = setup_of(
        "[tank]\nsize_m = [0.4, 0.2, 0.3]\ncells = [40, 20, 30]\n[fluid]\ndensity_kg_m3 = 900.0\n[smoke]\n"
        "[initial]\nvelocity_m_s = [0.1, 0.2, 0.3]\n"
        "[[source]]\ncentre_m = [0.1, 0.1, 0.1]\nradius_m = 0.02\nsmoke_per_s = 3.0\nstart_s = 1.0\nstop_s = "
        "2.0\n"
        "[[source]]\ncentre_m = [0.2, 0.1, 0.1]\nradius_m = 0.02\nvelocity_m_s = [0.0, 0.5, 0.0]\n"
        "[[body]]\nradius_m = 0.03\ncentre_m = [0.1, 0.1, 0.1]\nforce = false\n");
    EXPECT_EQ(s.cells, glm::ivec3(40, 20, 30));
    EXPECT_NEAR(s.cell_m, 0.01, 1e-15);
    EXPECT_EQ(s.density_kg_m3, 900.0);
    EXPECT_EQ(s.velocity_at_start(glm::dvec3(0.0)), glm::dvec3(0.1, 0.2, 0.3));
    ASSERT_EQ(s.sources.size(), 2u);
    EXPECT_EQ(s.sources[0].smoke_per_s, 3.0);
    EXPECT_FALSE(s.sources[0].velocity_m_s);
    EXPECT_EQ(s.sources[0].start_s, 1.0);
    EXPECT_EQ(s.sources[0].stop_s, 2.0);
    EXPECT_EQ(s.sources[1].smoke_per_s, 0.0);
    EXPECT_EQ(s.sources[1].velocity_m_s, glm::dvec3(0.0, 0.5, 0.0));
    EXPECT_TRUE(std::isinf(s.sources[1].stop_s));
    ASSERT_EQ(s.bodies.size(), 1u);
    EXPECT_EQ(std::get<gles::Sphere>(s.bodies[0].shape).radius_m, 0.03);
    EXPECT_FALSE(s.bodies[0].force);
    EXPECT_TRUE(s.bodies[0].torque);
}

TEST(FluidSetup, StartsFromTheVelocityOfAFile) {
    const ScratchFolder folder;
    std::vector<float> u(9 * 7 * 5 * 3);
    std::iota(u.begin(), u.end(), 0.0f);
    write_npy(folder / "u.npy", u, {5, 7, 9, 3});
    const std::string initial = "[initial]\nvelocity_npy = \"" + folder / "u.npy" + "\"\n";
    const std::string tank = "[tank]\nsize_m = [0.08, 0.06, 0.04]\ncells = [8, 6, 4]\n";
    const gles::FluidSetup s = setup_of(tank + initial);
    ASSERT_EQ(s.velocities_at_start.size(), 315u);
    EXPECT_EQ(s.velocities_at_start[1], glm::vec3(3.0f, 4.0f, 5.0f));
    const auto fault = [&](const std::string& scene) {
        try {
            setup_of(scene);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    const std::string shape =
        folder / "u.npy" + ": its shape is [5, 7, 9, 3], but this tank and solver have ";
    EXPECT_THAT(fault(initial), testing::StartsWith(shape + "[65, 65, 65, 3]: write it with outputs.fields"));
    EXPECT_THAT(fault(tank + initial + "[solver]\npreset = \"yang2009\"\n"),
                testing::StartsWith(shape + "[4, 6, 8, 3]: "));
    u[37] = std::numeric_limits<float>::quiet_NaN();
    write_npy(folder / "u.npy", u, {5, 7, 9, 3});
    EXPECT_EQ(fault(tank + initial), folder / "u.npy" + ": velocity number 12 is not finite");
}

TEST(FluidSetup, LetsTheFluidMoveFreeBodiesAndTurnTurningOnes) {
    const gles::FluidSetup s = setup_of(
        "[fluid]\ndensity_kg_m3 = 900\n"
        "[[body]]\nradius_m = 0.01\ncentre_m = [0.03, 0.08, 0.08]\n"
        "[[body]]\nradius_m = 0.01\ncentre_m = [0.08, 0.08, 0.08]\nmotion = \"free\"\ndensity_kg_m3 = 50\n"
        "[[body]]\nshape = \"box\"\nsize_m = [0.01, 0.02, 0.03]\nmotion = \"held\"\nturning = true\n");
    EXPECT_FALSE(s.bodies.at(0).coupled);
    EXPECT_TRUE(s.bodies.at(1).coupled.value().moves);
    EXPECT_TRUE(s.bodies.at(1).coupled.value().turns);
    EXPECT_EQ(s.bodies.at(1).coupled.value().density_kg_m3, 50.0);
    EXPECT_FALSE(s.bodies.at(2).coupled.value().moves);
    EXPECT_TRUE(s.bodies.at(2).coupled.value().turns);
    EXPECT_EQ(s.bodies.at(2).coupled.value().density_kg_m3, 900.0);
}

}  // namespace
}  // namespace eddy
