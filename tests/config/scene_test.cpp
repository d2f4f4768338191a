#include "config/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/config/everything.h"
#include "tests/config/whole_schema.h"

namespace eddy {
namespace {

using testing::HasSubstr;

std::array<std::string, 3> everything() {
    return scenes_with_every_key(testing::TempDir() + "eddy_everything");
}

TEST(Scene, EmptyFileIsTheDefaultScene) {
    EXPECT_EQ(read_scene("", "s.toml").scene, Scene{});
}

TEST(Scene, EffectsAreOnWhenTheirTableIsThere) {
    EXPECT_FALSE(read_scene("", "s.toml").scene.smoke);
    EXPECT_TRUE(read_scene("[smoke]", "s.toml").scene.smoke);
}

TEST(Scene, EveryKeyReachesItsField) {
    const Scene s = read_whole(everything()[0]).scene;
    EXPECT_EQ(s.title, "All \"keys\"");
    EXPECT_EQ(s.tank.cells, glm::ivec3(30, 20, 10));
    EXPECT_DOUBLE_EQ(s.tank.cell_m(), 0.01);
    EXPECT_EQ(s.tank.walls.x_low.kind, WallKind::Inflow);
    EXPECT_EQ(s.tank.walls.x_low.velocity_m_s.value().x, Formula::parse("0.1 * y * (0.2 - y)"));
    EXPECT_EQ(s.tank.walls.x_high.kind, WallKind::Open);
    EXPECT_EQ(s.fluid.density_kg_m3, 998.2);
    EXPECT_EQ(s.fluid.viscosity_pa_s, 0.001);
    EXPECT_EQ(s.fluid.gravity_m_s2, glm::dvec3(0, -9.81, 0));
    EXPECT_EQ(s.temperature.value().expansion_1_k, 0.0002);
    EXPECT_EQ(s.temperature.value().diffusivity_m2_s, 1.4e-7);
    EXPECT_EQ(s.temperature.value().initial_k.evaluate(0, 0.05, 0, 0), 20.0);
    EXPECT_EQ(s.smoke.value().dissipation_1_s, 0.1);
    EXPECT_EQ(s.smoke.value().weight, -0.5);
    EXPECT_EQ(s.smoke.value().initial.evaluate(0.1, 0, 0, 0), 1.0);
    EXPECT_EQ(s.vorticity_confinement.value().strength_1_s, 0.3);
    EXPECT_EQ(s.forcing.value().acceleration_m_s2.z, Formula(1e-3));
    EXPECT_EQ(s.initial.velocity_m_s.y, Formula(-0.1));
    ASSERT_EQ(s.sources.size(), 2u);
    EXPECT_EQ(s.sources[0].velocity_m_s, glm::dvec3(1e-7, 0.1, 12345678.9));
    EXPECT_EQ(s.sources[0].temperature_k_per_s, -4.0);
    EXPECT_EQ(s.sources[0].stop_s, 2.5);
    EXPECT_FALSE(s.sources[1].velocity_m_s);
    EXPECT_EQ(s.sources[1].name, "source2");
    ASSERT_EQ(s.bodies.size(), 5u);
    const Scene::Body& ball = s.bodies[0];
    EXPECT_EQ(ball.motion, BodyMotion::Prescribed);
    EXPECT_EQ(ball.acceleration_m_s2, glm::dvec3(4, 5, 6));
    EXPECT_EQ(ball.oscillation.value().phase_rad, 1.5);
    EXPECT_EQ(ball.oscillation.value().angle_deg, 30.0);
    EXPECT_FALSE(ball.force || ball.torque);
    EXPECT_EQ(s.bodies[1].blade_m, glm::dvec3(0.02, 0.03, 0.003));
    EXPECT_EQ(s.bodies[1].handle_radius_m, 0.002);
    EXPECT_EQ(s.bodies[1].handle_length_m, 0.03);
    EXPECT_TRUE(s.bodies[1].turning);
    EXPECT_EQ(s.bodies[2].axis, glm::dvec3(1, 1, 0));
    EXPECT_EQ(s.bodies[2].angle_deg, 45.0);
    EXPECT_EQ(s.bodies[2].tube_radius_m, 0.005);
    EXPECT_EQ(s.bodies[2].density_kg_m3, 1100.0);
    EXPECT_TRUE(s.bodies[3].inside_out);
    EXPECT_EQ(s.bodies[4].shape, BodyShape::Mesh);
    EXPECT_EQ(s.bodies[4].file.filename(), "fish.stl");
    EXPECT_EQ(s.bodies[4].scale, 0.001);
    EXPECT_EQ(s.solver.advection, AdvectionScheme::SemiLagrangian);
    EXPECT_EQ(s.solver.cycles, 4);
    EXPECT_EQ(s.solver.viscous_cycles, 3);
    EXPECT_EQ(s.solver.time_order, 2);
    EXPECT_FALSE(s.solver.jacobi_sweeps);
    EXPECT_EQ(s.haptics.gain, 1e5);
    EXPECT_EQ(s.render.background_colour, glm::dvec3(0.0));
    EXPECT_EQ(s.probes.at(1).quantity, ProbeQuantity::Temperature);
    EXPECT_EQ(s.probes.at(1).points, 31);
    EXPECT_EQ(s.probes.at(1).from_m, glm::dvec3(0, 0.1, 0.05));
    EXPECT_EQ(s.probes.at(1).to_m, glm::dvec3(0.3, 0.1, 0.05));
    EXPECT_TRUE(s.outputs.force_methods);
    EXPECT_EQ(s.outputs.fields, (std::vector{OutputField::Velocity, OutputField::Smoke,
                                             OutputField::Temperature, OutputField::Vorticity}));

    const Scene yang = read_whole(everything()[1]).scene;
    EXPECT_EQ(yang.bodies.at(0).spin_rad_s, glm::dvec3(7, 8, 9));
    EXPECT_EQ(yang.bodies.at(0).size_m, glm::dvec3(0.01, 0.02, 0.03));
    EXPECT_EQ(yang.bodies.at(1).length_m, 0.02);
    EXPECT_EQ(yang.bodies.at(2).thickness_m, 0.002);
    EXPECT_EQ(yang.bodies.at(3).radii_m, glm::dvec3(0.01, 0.02, 0.03));
    EXPECT_EQ(yang.bodies.at(4).edge_m, 0.02);
    EXPECT_EQ(yang.initial.velocity_npy.filename(), "u.npy");
    EXPECT_EQ(yang.solver.preset, SolverPreset::Yang2009);
    EXPECT_EQ(yang.solver.jacobi_sweeps, 60);
    EXPECT_EQ(yang.solver.force_sum, ForceSum::Cpu);
    EXPECT_EQ(read_whole(everything()[2]).scene.imposed.value().velocity_m_s.x, Formula::parse("-y"));
}

// Or the tests that stand on these scenes would leave a key out.
TEST(Scene, EveryKeyOfTheReferenceIsInTheScenesWithEveryKey) {
    std::string text;
    for (const std::string& scene : everything()) text += scene;
    std::istringstream rows(schema_reference());
    for (std::string row; std::getline(rows, row);) {
        if (!row.starts_with("| `")) continue;
        const std::string key = row.substr(3, row.find('`', 3) - 3);
        EXPECT_TRUE(text.find("\n" + key + " = ") != std::string::npos ||
                    text.find(" " + key + " = ") != std::string::npos)
            << key;
    }
}

TEST(Scene, HandStartsInTheMiddleOfTheTankAndHoldsItsBodyThere) {
    const Scene s = read_scene(
                        "[tank]\nsize_m = [0.4, 0.2, 0.2]\ncells = [64, 32, 32]\n"
                        "[[body]]\nradius_m = 0.01\nmotion = \"held\"",
                        "s.toml")
                        .scene;
    EXPECT_EQ(s.haptics.centre_m, glm::dvec3(0.2, 0.1, 0.1));
    EXPECT_EQ(s.bodies.at(0).centre_m, s.haptics.centre_m);
    EXPECT_EQ(s.bodies.at(0).name, "body1");
}

TEST(Scene, PrintedSceneReadsBackTheSame) {
    for (const std::string& text : everything()) {
        const Scene scene = read_whole(text).scene;
        EXPECT_EQ(read_whole(print_scene(scene)).scene, scene) << print_scene(scene);
    }
    EXPECT_EQ(read_scene(print_scene(Scene{}), "printed").scene, Scene{});
}

TEST(Scene, PrintedOriginsSayFileAndLineOrDefault) {
    const LoadedScene loaded =
        read_scene("[tank]\nwalls = \"slip\"\n[[body]]\nradius_m = 0.01\nmotion = \"held\"\n", "s.toml",
                   std::vector<std::string>{"solver.dt_s=0.01"});
    const std::string text = print_scene(loaded.scene, &loaded.origins);
    EXPECT_THAT(text, HasSubstr("\nx_low = \"slip\"  # s.toml:2:9\n"));
    EXPECT_THAT(text, HasSubstr("\nradius_m = 0.01  # s.toml:4:12\n"));
    EXPECT_THAT(text, HasSubstr("\nname = \"body1\"  # default\n"));
    EXPECT_THAT(text, HasSubstr("\ndt_s = 0.01  # --set:1:13\n"));
    EXPECT_THAT(text, HasSubstr("\ncells = [64, 64, 64]  # default\n"));
    EXPECT_EQ(read_scene(text, "printed").scene, loaded.scene);
}

TEST(Scene, PrintedWallsKeepTheOriginsOfTheirKeys) {
    const LoadedScene loaded = read_whole(everything()[0]);
    const std::string text = print_scene(loaded.scene, &loaded.origins);
    EXPECT_THAT(text, HasSubstr("\nx_high = \"open\"  # s.toml:9:10\n"));
    EXPECT_THAT(text, HasSubstr("\nz_low = \"no_slip\"  # s.toml:12:9\n"));
    EXPECT_THAT(text, HasSubstr("\n[tank.walls.x_low]\nkind = \"inflow\"  # s.toml:8:18\n"
                                "velocity_m_s = [\"0.1 * y * (0.2 - y)\", 0, 0]  # s.toml:8:43\n"));
    EXPECT_EQ(read_whole(text).scene, loaded.scene);
}

TEST(Scene, PrintedBodiesHaveTheSizesOfTheirShapeOnly) {
    const std::string text = print_scene(read_whole(everything()[1]).scene);
    EXPECT_THAT(text,
                HasSubstr("shape = \"cylinder\"\nradius_m = 0.01\nlength_m = 0.02\ninside_out = false\n"));
}

TEST(Scene, IsToldFromSettingsByItsTables) {
    const std::filesystem::path folder = testing::TempDir() + "eddy_holds_a_scene";
    std::filesystem::create_directories(folder);
    const auto holds = [&](const std::string& text) {
        std::ofstream(folder / "file.toml") << text;
        return holds_a_scene(folder / "file.toml");
    };
    EXPECT_TRUE(holds("[tank]\n"));
    EXPECT_TRUE(holds("[[body]]\n"));
    EXPECT_TRUE(holds("tank.cells = [16, 16, 16]\n"));
    EXPECT_TRUE(holds("haptics = { gain = 2 }\n"));
    EXPECT_TRUE(holds("title = \"x\"\n"));
    EXPECT_FALSE(holds("scene = \"[tank]\"\n"));
    EXPECT_FALSE(holds("# [tank]\nhaptics = \"none\"\n"));
    EXPECT_FALSE(holds(""));
    EXPECT_THROW(holds("[tank\n"), ConfigError);
    EXPECT_THROW(holds_a_scene(folder / "absent.toml"), ConfigError);
    std::filesystem::remove_all(folder);
}

TEST(Scene, MeshAndFieldFilesAreTakenFromTheFolderOfTheScene) {
    const Scene scene = read_whole(everything()[0]).scene;
    const std::filesystem::path folder = testing::TempDir() + "eddy_everything";
    EXPECT_EQ(scene.bodies.at(4).file, folder / "fish.stl");
    EXPECT_EQ(read_whole(everything()[1]).scene.initial.velocity_npy, folder / "u.npy");
}

TEST(Scene, PathFileIsTakenFromTheFolderOfTheScene) {
    const std::filesystem::path folder = testing::TempDir() + "eddy_scene_test";
    std::filesystem::create_directories(folder / "motions");
    std::ofstream(folder / "motions/wave.csv") << "t_s,x_m,y_m,z_m\n";
    std::ofstream(folder / "wave.toml")
        << "[[body]]\nradius_m = 0.01\ncentre_m = [0.1, 0.1, 0.1]\nmotion = \"prescribed\"\n"
           "path_csv = \"./motions/wave.csv\"\n";
    const Scene scene = load_scene((folder / "wave.toml").string()).scene;
    EXPECT_EQ(scene.bodies.at(0).path_csv, folder / "motions/wave.csv");
    EXPECT_EQ(read_scene(print_scene(scene), "elsewhere/printed.toml").scene, scene);
    std::filesystem::remove_all(folder);
}

class ShippedScene : public testing::TestWithParam<std::string_view> {};

TEST_P(ShippedScene, LoadsAndPrintsAndReadsBack) {
    const Scene scene = load_scene(std::string(GetParam())).scene;
    EXPECT_FALSE(scene.title.empty());
    EXPECT_FALSE(scene.description.empty());
    EXPECT_EQ(read_scene(print_scene(scene), "printed").scene, scene);
}

std::string test_name(const testing::TestParamInfo<std::string_view>& scene) {
    std::string name(scene.param);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '/' || c == '-' || c == '.'; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(shipped_scenes()), test_name);
INSTANTIATE_TEST_SUITE_P(Validation, ShippedScene, testing::ValuesIn(validation_scenes()), test_name);

TEST(ValidationScenes, AreNamedWithTheirFolderAndAreNoFiles) {
    EXPECT_FALSE(is_scene_file("validation/A1"));
    EXPECT_TRUE(is_scene_file("validation/A1.toml"));
    EXPECT_TRUE(is_scene_file("./validation/A1"));
    EXPECT_EQ(load_scene("validation/A1").origins.at("tank.cells").file, "config/scenes/validation/A1.toml");
}

TEST(ShippedScenes, AreTheOnesForVisitorsAndForTimes) {
    const std::vector<std::string_view> names = {"bench", "bubble", "everything", "float",
                                                 "jet",   "rest",   "stir"};
    EXPECT_EQ(shipped_scenes(), names);
}

TEST(ShippedScenes, KeepThePromisesOfTheirComments) {
    const Scene jet = load_scene("jet").scene;
    EXPECT_EQ(jet.bodies.at(0).motion, BodyMotion::Held);
    EXPECT_TRUE(jet.smoke);
    EXPECT_TRUE(jet.sources.at(0).velocity_m_s);

    const Scene stir = load_scene("stir").scene;
    EXPECT_EQ(stir.bodies.at(0).motion, BodyMotion::Held);
    EXPECT_FALSE(stir.sources.at(0).velocity_m_s);
}

}  // namespace
}  // namespace eddy
