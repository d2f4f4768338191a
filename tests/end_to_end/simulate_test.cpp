#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>
#include <regex>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

/// A NumPy file of little-endian 32-bit floats.
struct Npy {
    std::vector<std::size_t> shape;
    std::vector<float> values;
};

Npy read_npy(const std::filesystem::path& file) {
    const std::string bytes = read_all(file);
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8)) << file;
    const auto byte = [&](std::size_t i) {
        return static_cast<std::size_t>(static_cast<unsigned char>(bytes.at(i)));
    };
    const std::size_t start = 10 + byte(8) + 256 * byte(9);
    const std::string header = bytes.substr(10, start - 10);
    EXPECT_NE(header.find("'descr': '<f4'"), std::string::npos) << header;
    EXPECT_NE(header.find("'fortran_order': False"), std::string::npos) << header;
    Npy array;
    std::smatch m;
    EXPECT_TRUE(std::regex_search(header, m, std::regex(R"('shape': \(([^)]*)\))"))) << header;
    for (const std::string& n : split(m[1], ','))
        if (n.find_first_of("0123456789") != std::string::npos) array.shape.push_back(std::stoul(n));
    array.values.resize((bytes.size() - start) / sizeof(float));
    std::memcpy(array.values.data(), bytes.data() + start, array.values.size() * sizeof(float));
    EXPECT_EQ(array.values.size(),
              std::accumulate(array.shape.begin(), array.shape.end(), std::size_t{1}, std::multiplies<>()));
    return array;
}

TEST(Simulate, OfStillAirWritesASeriesOfForcesThatAreExactlyZero) {
    const ScratchFolder folder;
    const std::string out = folder / "out";
    const Ended ended = eddy({"simulate", "rest", "--set", kTiny, "--steps", "3", "--out", out});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    EXPECT_EQ(folder.listing(), (std::vector<std::string>{"out/", "out/series.csv", "out/summary.json"}));

    const std::vector<std::string> lines = lines_of(read_all(out + "/series.csv"));
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_EQ(
        lines[0],
        "t_s,body,force_x_n,force_y_n,force_z_n,torque_x_nm,torque_y_nm,torque_z_nm,kinetic_energy_j,"
        "divergence_max_1_s,pressure_residual,smoke_total,step_ms,x_m,y_m,z_m,velocity_x_m_s,velocity_y_m_s,"
        "velocity_z_m_s,orientation_w,orientation_x,orientation_y,orientation_z,spin_x_rad_s,spin_y_rad_s,"
        "spin_z_rad_s");
    for (std::size_t row = 1; row < lines.size(); ++row) {
        const std::vector<std::string> cells = split(lines[row], ',');
        ASSERT_EQ(cells.size(), 26u) << lines[row];
        EXPECT_NEAR(std::stod(cells[0]), 0.02 * static_cast<double>(row), 1e-9);
        EXPECT_EQ(cells[1], "ball");
        for (std::size_t column = 2; column < 12; ++column)
            EXPECT_EQ(std::stod(cells[column]), 0.0) << lines[row];
        EXPECT_GT(std::stod(cells[12]), 0.0);
    }

    const nlohmann::json summary = nlohmann::json::parse(read_all(out + "/summary.json"));
    EXPECT_EQ(summary.at("title"), "Rest");
    EXPECT_EQ(summary.at("steps"), 3);
    EXPECT_NEAR(summary.at("simulated_s"), 0.06, 1e-12);
    EXPECT_EQ(summary.at("bodies").at(0).at("last_force_n"), nlohmann::json({0.0, 0.0, 0.0}));
    EXPECT_FALSE(summary.at("renderer").get<std::string>().empty());
}

TEST(Simulate, WritesTheFieldsTheSceneAsksFor) {
    const ScratchFolder folder;
    const std::string out = folder / "out";
    const Ended ended =
        eddy({"simulate", "jet", "--set", "tank.size_m=[0.16,0.2,0.24]", "--set", "tank.cells=[16,20,24]",
              "--set", "outputs.fields=[\"velocity\",\"pressure\",\"smoke\"]", "--set",
              "outputs.series=false", "--steps", "2", "--out", out});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(folder.listing(), (std::vector<std::string>{"out/", "out/pressure.npy", "out/smoke.npy",
                                                          "out/summary.json", "out/velocity.npy"}));
    EXPECT_EQ(read_npy(out + "/velocity.npy").shape, (std::vector<std::size_t>{25, 21, 17, 3}));
    EXPECT_EQ(read_npy(out + "/pressure.npy").shape, (std::vector<std::size_t>{24, 20, 16}));
    const Npy smoke = read_npy(out + "/smoke.npy");
    EXPECT_EQ(smoke.shape, (std::vector<std::size_t>{24, 20, 16}));

    // The jet comes out at (0.02, 0.14, 0.08) m, with cells of 1 cm: the smoke's middle lies there.
    double total = 0.0, x = 0.0, y = 0.0, z = 0.0;
    for (std::size_t i = 0; i < smoke.values.size(); ++i) {
        total += smoke.values[i];
        x += smoke.values[i] * (static_cast<double>(i % 16) + 0.5);
        y += smoke.values[i] * (static_cast<double>(i / 16 % 20) + 0.5);
        z += smoke.values[i] * (static_cast<double>(i / 320) + 0.5);
    }
    EXPECT_NEAR(x / total, 2.0, 1.0);
    EXPECT_NEAR(y / total, 14.0, 1.0);
    EXPECT_NEAR(z / total, 8.0, 1.0);
    const nlohmann::json summary = nlohmann::json::parse(read_all(out + "/summary.json"));
    EXPECT_NEAR(summary.at("smoke_total").get<double>(), total * 1e-6, 1e-5 * total * 1e-6);
}

TEST(Simulate, WithoutABodyStillHasARowForEachStep) {
    const ScratchFolder folder;
    const std::string scene = folder.write("empty.toml", "[tank]\ncells = [16, 16, 16]\n");
    const Ended ended = eddy({"simulate", scene, "--steps", "2", "--out", folder / "out"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::vector<std::string> lines = lines_of(read_all(folder / "out/series.csv"));
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(split(lines[1], ',').at(1), "-");
}

TEST(Simulate, WritesTheHeatOfAWarmTank) {
    const ScratchFolder folder;
    const std::string scene =
        folder.write("warm.toml",
                     "[tank]\nsize_m = [0.1, 0.2, 0.2]\ncells = [8, 16, 16]\n[temperature]\n"
                     "diffusivity_m2_s = 1e-3\ninitial_k = \"100 * x\"\n"
                     "[outputs]\nfields = [\"temperature\"]\n");
    const std::string out = folder / "out";
    const Ended ended = eddy({"simulate", scene, "--steps", "3", "--out", out});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::vector<std::string> lines = lines_of(read_all(out + "/series.csv"));
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_EQ(split(lines[0], ',').back(), "temperature_total_k_m3");
    // On average 5 K in 0.004 m^3.
    for (std::size_t row = 1; row < lines.size(); ++row)
        EXPECT_NEAR(std::stod(split(lines[row], ',').back()), 0.02, 1e-7);
    const Npy temperature = read_npy(out + "/temperature.npy");
    EXPECT_EQ(temperature.shape, (std::vector<std::size_t>{16, 16, 8}));
    EXPECT_LT(temperature.values.front(), temperature.values.back());
    EXPECT_NEAR(nlohmann::json::parse(read_all(out + "/summary.json")).at("temperature_total_k_m3"), 0.02,
                1e-7);
}

TEST(Simulate, WritesWhatProbesMeasureAndTheVorticity) {
    const ScratchFolder folder;
    const std::string scene =
        folder.write("turn.toml",
                     "[tank]\nsize_m = [0.1, 0.2, 0.2]\ncells = [8, 16, 16]\n"
                     "[imposed]\nvelocity_m_s = [\"-3 * y\", \"3 * x\", \"t\"]\n"
                     "[[probe]]\nname = \"hub\"\nquantity = \"velocity\"\npoint_m = [0.01, 0.02, 0.03]\n"
                     "[solver]\ndt_s = 0.5\n[outputs]\nfields = [\"vorticity\"]\n");
    const std::string out = folder / "out";
    const Ended ended = eddy({"simulate", scene, "--steps", "2", "--out", out});
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.out.find("divergence"), std::string::npos) << ended.out;
    const std::vector<std::string> lines = lines_of(read_all(out + "/series.csv"));
    ASSERT_EQ(lines.size(), 3u);
    const std::vector<std::string> last = split(lines[2], ',');
    ASSERT_EQ(last.size(), 29u) << lines[2];
    EXPECT_EQ(split(lines[0], ',').at(26), "hub_velocity_x_m_s");
    EXPECT_NEAR(std::stod(last[26]), -0.06, 1e-6);
    EXPECT_NEAR(std::stod(last[27]), 0.03, 1e-6);
    EXPECT_NEAR(std::stod(last[28]), 1.0, 1e-6);
    const Npy curl = read_npy(out + "/vorticity.npy");
    EXPECT_EQ(curl.shape, (std::vector<std::size_t>{16, 16, 8, 3}));
    for (std::size_t i = 0; i < curl.values.size(); ++i)
        EXPECT_NEAR(curl.values[i], i % 3 == 2 ? 6.0 : 0.0, 1e-3);
}

TEST(Simulate, GoesOnFromTheVelocityOfAnEarlierRun) {
    // Without pressure to speak of, smoke or bodies, a flow knows nothing but its velocity: the last step but for the
    // first guess of its pressure.
    const ScratchFolder folder;
    const std::string tank =
        "[tank]\ncells = [16, 16, 16]\n[solver]\ncycles = 20\n"
        "[outputs]\nfields = [\"velocity\"]\n[initial]\n";
    const std::string whirl =
        folder.write("whirl.toml", tank + "velocity_m_s = [\"y - 0.08\", \"0.08 - x\", \"x * y\"]\n");
    const std::string again = folder.write("again.toml", tank + "velocity_npy = \"one/velocity.npy\"\n");
    for (const auto& [scene, steps, out] :
         {std::tuple(whirl, "1", "one"), {whirl, "2", "two"}, {again, "1", "then"}}) {
        const Ended ended = eddy({"simulate", scene, "--steps", steps, "--out", folder / out});
        ASSERT_EQ(ended.status, 0) << ended.err;
    }
    const Npy two = read_npy(folder / "two/velocity.npy"), then = read_npy(folder / "then/velocity.npy"),
              one = read_npy(folder / "one/velocity.npy");
    double difference = 0.0, change = 0.0;
    for (std::size_t i = 0; i < two.values.size(); ++i) {
        difference = std::max(difference, std::abs(static_cast<double>(two.values[i] - then.values[i])));
        change = std::max(change, std::abs(static_cast<double>(two.values[i] - one.values[i])));
    }
    EXPECT_GT(change, 1e-4);
    EXPECT_LT(difference, 1e-3 * change);
}

/// A ball that speeds up beside a box, their forces measured three ways. `more`: of the box.
std::string ball_and_box(const std::string& more) {
    return R"(
[tank]
size_m = [0.16, 0.16, 0.16]
cells = [16, 16, 16]
[outputs]
force_methods = true
[[body]]
name = "ball"
shape = "sphere"
radius_m = 0.03
centre_m = [0.05, 0.06, 0.08]
motion = "prescribed"
acceleration_m_s2 = [1, 0, 0]
[[body]]
name = "box"
shape = "box"
size_m = [0.04, 0.04, 0.04]
centre_m = [0.11, 0.1, 0.08]
)" + more;
}

TEST(Simulate, MeasuresTheForceThreeWaysWhereASceneAsksForIt) {
    const ScratchFolder folder;
    const std::string out = folder / "out";
    const std::string scene = folder.write("two.toml", ball_and_box(""));
    const Ended ended = eddy({"simulate", scene, "--steps", "3", "--out", out});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const std::vector<std::string> lines = lines_of(read_all(out + "/series.csv"));
    ASSERT_EQ(lines.size(), 7u);
    const std::vector<std::string> names = split(lines[0], ',');
    const auto column = [&](const std::string& name) {
        return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    for (std::size_t row = 1; row < lines.size(); ++row) {
        const std::vector<std::string> cells = split(lines[row], ',');
        ASSERT_EQ(cells.size(), names.size());
        const auto value = [&](const std::string& name) { return std::stod(cells.at(column(name))); };
        const double force = value("force_x_n");
        EXPECT_NE(force, 0.0);
        EXPECT_NEAR(value("force_box_x_n"), force, 1e-4 * std::abs(force)) << lines[row];
        EXPECT_NEAR(value("force_impulse_x_n"), force, 1e-4 * std::abs(force)) << lines[row];
        EXPECT_TRUE(std::isfinite(value("transport_x_n")));
    }
    const nlohmann::json summary = nlohmann::json::parse(read_all(out + "/summary.json"));
    for (const nlohmann::json& body : summary.at("bodies")) {
        const double spread = body.at("force_methods").at("spread_over_force");
        EXPECT_LT(spread, 1e-4);
        EXPECT_GE(body.at("force_methods").at("transport_over_force").get<double>(), 0.0);
    }
}

TEST(Simulate, ComparesNoForcesOnABodyWhoseForceIsNotMeasured) {
    const ScratchFolder folder;
    const std::string out = folder / "out";
    const std::string scene = folder.write("two.toml", ball_and_box("force = false\ntorque = false\n"));
    const Ended ended = eddy({"simulate", scene, "--steps", "2", "--out", out});
    ASSERT_EQ(ended.status, 0) << ended.err;
    const nlohmann::json bodies = nlohmann::json::parse(read_all(out + "/summary.json")).at("bodies");
    EXPECT_TRUE(bodies.at(0).contains("force_methods"));
    EXPECT_FALSE(bodies.at(1).contains("force_methods"));
    EXPECT_THAT(ended.out, testing::ContainsRegex("on ball at the end.*\nmeasured three ways"));
    EXPECT_THAT(ended.out, testing::Not(testing::ContainsRegex("on box at the end.*\nmeasured three ways")));
}

TEST(Simulate, ReplacesAnEarlierResult) {
    const ScratchFolder folder;
    const std::string out = folder / "out";
    for (const std::string steps : {"3", "2"})
        ASSERT_EQ(eddy({"simulate", "rest", "--set", kTiny, "--steps", steps, "--out", out}).status, 0);
    EXPECT_EQ(lines_of(read_all(out + "/series.csv")).size(), 3u);
    EXPECT_EQ(nlohmann::json::parse(read_all(out + "/summary.json")).at("steps"), 2);
}

}  // namespace
}  // namespace eddy
