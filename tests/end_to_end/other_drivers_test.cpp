#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

// Two more GL drivers than the rasteriser that everything else here runs on. Both are Mesa's and chosen by environment:
// softpipe, an interpreter of its own (libgl1-mesa-dri), and zink, OpenGL over Vulkan, on lavapipe (mesa-vulkan-drivers).
// They differ in shader compiler, extensions and rounding; the forces may not.

constexpr char kBall[] = R"(
[tank]
size_m = [0.08, 0.07, 0.08]
cells = [8, 7, 8]
[fluid]
density_kg_m3 = 1000
[[body]]
shape = "sphere"
radius_m = 0.021
centre_m = [0.035, 0.033, 0.042]
motion = "prescribed"
velocity_m_s = [0.2, 0.1, -0.15]
[solver]
preset = "precise"
)";

constexpr char kCreep[] = R"(
[tank]
size_m = [0.08, 0.07, 0.08]
cells = [8, 7, 8]
walls = "no_slip"
[fluid]
density_kg_m3 = 1260
viscosity_pa_s = 1.4
[[body]]
shape = "sphere"
radius_m = 0.021
centre_m = [0.042, 0.034, 0.037]
motion = "prescribed"
velocity_m_s = [0.001, 0.0005, 0]
spin_rad_s = [0, 0.02, 0.03]
)";

constexpr char kJet[] = R"(
[tank]
size_m = [0.08, 0.08, 0.07]
cells = [8, 8, 7]
[fluid]
density_kg_m3 = 1.2
gravity_m_s2 = [0, -0.2, 0]
[smoke]
weight = 2
[[source]]
centre_m = [0.015, 0.065, 0.035]
radius_m = 0.018
smoke_per_s = 25
velocity_m_s = [0.4, -0.35, 0]
[[body]]
shape = "box"
size_m = [0.03, 0.02, 0.03]
centre_m = [0.045, 0.032, 0.033]
axis = [1, 1, 0]
angle_deg = 25
)";

struct Row {
    glm::dvec3 force_n{0.0}, torque_nm{0.0};
    double energy_j = 0.0, smoke = 0.0;
};

struct Outcome {
    Ended ended;
    std::string renderer;
    std::vector<Row> rows;

    bool on(const std::string& driver) const { return renderer.rfind(driver, 0) == 0; }
};

Outcome run_on(const std::string& driver, const std::string& scene_text) {
    const ScratchFolder folder;
    const std::string scene = folder.write("scene.toml", scene_text);
    std::vector<std::string> command{"env", "-u", "MESA_LOADER_DRIVER_OVERRIDE", "LIBGL_ALWAYS_SOFTWARE=1",
                                     "GALLIUM_DRIVER=" + driver};
    // Where several vendors' drivers are installed, Mesa's.
    const std::string mesa = "/usr/share/glvnd/egl_vendor.d/50_mesa.json";
    if (std::filesystem::exists(mesa)) command.push_back("__EGL_VENDOR_LIBRARY_FILENAMES=" + mesa);
    for (const std::string& word : eddy_command({"simulate", scene, "--steps", "4", "--out", folder / "out"}))
        command.push_back(word);
    // Compiling its shaders may take such a driver most of a minute.
    Outcome outcome{Program(command).wait(std::chrono::minutes(3)), {}, {}};
    if (outcome.ended.status != 0) return outcome;
    outcome.renderer = nlohmann::json::parse(read_all(folder / "out/summary.json")).at("renderer");
    for (const std::string& line : lines_of(read_all(folder / "out/series.csv"))) {
        if (line[0] == 't') continue;
        const std::vector<std::string> cells = split(line, ',');
        const auto number = [&](std::size_t column) { return std::stod(cells.at(column)); };
        outcome.rows.push_back(
            {{number(2), number(3), number(4)}, {number(5), number(6), number(7)}, number(8), number(11)});
    }
    return outcome;
}

bool lavapipe_is_installed() {
    for (const char* folder : {"/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"}) {
        std::error_code none;
        for (const auto& entry : std::filesystem::directory_iterator(folder, none))
            if (entry.path().filename().string().rfind("lvp_icd", 0) == 0) return true;
    }
    return false;
}

/// Force, torque, energy and smoke of every step within one part in a thousand of the usual driver's.
void expect_the_same(const std::string& driver, const std::string& scene) {
    const Outcome other = run_on(driver, scene);
    if (driver == "zink" && !other.on("zink") && !lavapipe_is_installed())
        GTEST_SKIP() << "skipped: no Vulkan driver for zink; install mesa-vulkan-drivers";
    ASSERT_EQ(other.ended.status, 0) << driver << ": " << other.ended.err;
    if (driver == "softpipe" && !other.on("softpipe"))
        GTEST_SKIP() << "skipped: libgl1-mesa-dri came with " << other.renderer << ", but without softpipe";
    ASSERT_TRUE(other.on(driver)) << "it ran on " << other.renderer;
    const Outcome usual = run_on("llvmpipe", scene);
    ASSERT_EQ(usual.ended.status, 0) << usual.ended.err;
    ASSERT_TRUE(usual.on("llvmpipe")) << "it ran on " << usual.renderer;

    constexpr double kWithin = 1e-3, kLength = 0.02;  // [m] of the bodies
    ASSERT_EQ(other.rows.size(), usual.rows.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < usual.rows.size(); ++i) {
        const Row &a = usual.rows[i], &b = other.rows[i];
        const double force = glm::length(a.force_n);
        // A ball in an inviscid fluid feels no torque but what rounding leaves.
        const double torque = std::max(glm::length(a.torque_nm), 1e-3 * kLength * force);
        EXPECT_GT(force, 0.0);
        EXPECT_LT(glm::length(b.force_n - a.force_n), kWithin * force) << "step " << i;
        EXPECT_LT(glm::length(b.torque_nm - a.torque_nm), kWithin * torque) << "step " << i;
        EXPECT_NEAR(b.energy_j, a.energy_j, kWithin * a.energy_j) << "step " << i;
        EXPECT_NEAR(b.smoke, a.smoke, kWithin * a.smoke) << "step " << i;
        worst = std::max({worst, glm::length(b.force_n - a.force_n) / force,
                          glm::length(b.torque_nm - a.torque_nm) / torque});
    }
    testing::Test::RecordProperty("worst", fmt::format("{:.2g}", worst));
}

TEST(Softpipe, FeelsTheSameForceOnABallThatSetsOff) {
    expect_the_same("softpipe", kBall);
}
TEST(Softpipe, FeelsTheSameForceAndTorqueInCreepingFlow) {
    expect_the_same("softpipe", kCreep);
}
TEST(Softpipe, FeelsTheSameForceAndTorqueInAJetOfHeavySmoke) {
    expect_the_same("softpipe", kJet);
}
TEST(ZinkOnLavapipe, FeelsTheSameForceOnABallThatSetsOff) {
    expect_the_same("zink", kBall);
}
TEST(ZinkOnLavapipe, FeelsTheSameForceAndTorqueInCreepingFlow) {
    expect_the_same("zink", kCreep);
}
TEST(ZinkOnLavapipe, FeelsTheSameForceAndTorqueInAJetOfHeavySmoke) {
    expect_the_same("zink", kJet);
}

}  // namespace
}  // namespace eddy
