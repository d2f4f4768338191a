#include "config/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace eddy {
namespace {

using testing::HasSubstr;

// Every key there is, none at its default.
const std::string kEverything = R"(
title = "All \"keys\""
description = "tab\tand\nline, é"
[tank]
size_m = [0.3, 0.2, 0.1]
cells = [30, 20, 10]
walls = { x_low = "slip" }
[fluid]
density_kg_m3 = 998.2
[smoke]
dissipation_1_s = 0.1
[[source]]
name = "wind"
centre_m = [0.1, 0.1, 0.05]
radius_m = 0.02
smoke_per_s = 3
velocity_m_s = [1e-7, 0.1, 12345678.9]
start_s = 1
stop_s = 2.5
[[source]]
centre_m = [0.1, 0.1, 0.05]
radius_m = 0.02
smoke_per_s = 4
[[body]]
name = "ball"
shape = "sphere"
radius_m = 0.01
centre_m = [0.1, 0.1, 0.1]
motion = "prescribed"
velocity_m_s = [1, 2, 3]
acceleration_m_s2 = [4, 5, 6]
spin_rad_s = [7, 8, 9]
start_s = 0.3333333333333333
force = false
torque = false
oscillation = { amplitude_m = [0.01, 0, 0], frequency_hz = 2, phase_rad = 1.5 }
[[body]]
radius_m = 0.01
motion = "held"
[initial]
velocity_m_s = [0.1, -0.1, 0.05]
[solver]
preset = "yang2009"
dt_s = 0.01
advection = "maccormack"
jacobi_sweeps = 40
[haptics]
gain = 1e5
max_force_n = 2
workspace_scale = 1.5
centre_m = [0.1, 0.12, 0.02]
[render]
width_px = 1920
height_px = 1080
azimuth_deg = -30
elevation_deg = 40
distance_factor = 2
smoke_colour = [1, 0.5, 0.25]
background_colour = [0, 0, 0]
exposure = 2
extinction_1_m = 100
[outputs]
duration_s = 3
series = false
fields = ["velocity", "smoke"]
)";

TEST(Scene, EmptyFileIsTheDefaultScene) {
    EXPECT_EQ(read_scene("", "s.toml").scene, Scene{});
}

TEST(Scene, EffectsAreOnWhenTheirTableIsThere) {
    EXPECT_FALSE(read_scene("", "s.toml").scene.smoke);
    EXPECT_TRUE(read_scene("[smoke]", "s.toml").scene.smoke);
}

TEST(Scene, EveryKeyReachesItsField) {
    const Scene s = read_scene(kEverything, "s.toml").scene;
    EXPECT_EQ(s.title, "All \"keys\"");
    EXPECT_EQ(s.tank.cells, glm::ivec3(30, 20, 10));
    EXPECT_DOUBLE_EQ(s.tank.cell_m(), 0.01);
    EXPECT_EQ(s.fluid.density_kg_m3, 998.2);
    EXPECT_EQ(s.smoke.value().dissipation_1_s, 0.1);
    ASSERT_EQ(s.sources.size(), 2u);
    EXPECT_EQ(s.sources[0].velocity_m_s, glm::dvec3(1e-7, 0.1, 12345678.9));
    EXPECT_EQ(s.sources[0].stop_s, 2.5);
    EXPECT_FALSE(s.sources[1].velocity_m_s);
    EXPECT_EQ(s.sources[1].name, "source2");
    ASSERT_EQ(s.bodies.size(), 2u);
    const Scene::Body& ball = s.bodies[0];
    EXPECT_EQ(ball.motion, BodyMotion::Prescribed);
    EXPECT_EQ(ball.acceleration_m_s2, glm::dvec3(4, 5, 6));
    EXPECT_EQ(ball.spin_rad_s, glm::dvec3(7, 8, 9));
    EXPECT_EQ(ball.oscillation.value().phase_rad, 1.5);
    EXPECT_FALSE(ball.force || ball.torque);
    EXPECT_EQ(s.solver.preset, SolverPreset::Yang2009);
    EXPECT_EQ(s.solver.advection, AdvectionScheme::MacCormack);
    EXPECT_EQ(s.solver.jacobi_sweeps, 40);
    EXPECT_FALSE(s.solver.cycles);
    EXPECT_EQ(s.haptics.gain, 1e5);
    EXPECT_EQ(s.render.background_colour, glm::dvec3(0.0));
    EXPECT_EQ(s.outputs.fields, (std::vector{OutputField::Velocity, OutputField::Smoke}));
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
    const Scene scene = read_scene(kEverything, "s.toml").scene;
    EXPECT_EQ(read_scene(print_scene(scene), "printed").scene, scene) << print_scene(scene);
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

INSTANTIATE_TEST_SUITE_P(All, ShippedScene, testing::ValuesIn(shipped_scenes()),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(ShippedScenes, AreTheOnesTheExhibitAndTheAccuracyTestsName) {
    const std::vector<std::string_view> names = {"added_mass", "bench", "jet", "rest", "slide", "stir"};
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

    const Scene added_mass = load_scene("added_mass").scene;
    EXPECT_DOUBLE_EQ(added_mass.bodies.at(0).radius_m, 6 * added_mass.tank.cell_m());

    const Scene slide = load_scene("slide").scene;
    const Scene::Body& ball = slide.bodies.at(0);
    EXPECT_DOUBLE_EQ(ball.radius_m, 4 * slide.tank.cell_m());
    EXPECT_NEAR(ball.velocity_m_s.x * slide.solver.dt_s, 0.2 * slide.tank.cell_m(), 1e-15);
    const double end = ball.centre_m.x + ball.velocity_m_s.x * slide.outputs.duration_s;
    EXPECT_GE(slide.tank.size_m.x - end,
              ball.centre_m.x);  // as far from the right wall as it was from the left
}

}  // namespace
}  // namespace eddy
