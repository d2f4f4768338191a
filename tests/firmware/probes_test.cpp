#include "firmware/probes.h"

#include <gmock/gmock.h>

#include "firmware/fluid_setup.h"
#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

using testing::ElementsAre;

/// Probes at a corner of the tank, in the middle of a wall and somewhere inside.
const std::string kPlaces[] = {"[0, 0.2, 0]", "[0.16, 0.1, 0.05]", "[0.0537, 0.1234, 0.0911]"};
const glm::dvec3 kPlacesM[] = {{0.0, 0.2, 0.0}, {0.16, 0.1, 0.05}, {0.0537, 0.1234, 0.0911}};

std::string probes_of(const std::string& quantity) {
    std::string text;
    for (const std::string& place : kPlaces)
        text += "[[probe]]\nquantity = \"" + quantity + "\"\npoint_m = " + place + "\n";
    return text;
}

class ProbesTest : public gles::GlTest {
  protected:
    /// What the probes of a scene read after one step.
    std::vector<double> read(const std::string& more) {
        const Scene scene =
            read_scene("[tank]\nsize_m = [0.16, 0.2, 0.12]\ncells = [16, 20, 12]\n" + more, "s.toml").scene;
        const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, fluid_setup(scene));
        fluid->step(0.1, {}, false);
        return Probes(scene).read(*fluid);
    }
};

TEST_F(ProbesTest, ReadALinearFlowExactly) {
    const std::vector<double> u =
        read("[imposed]\nvelocity_m_s = [\"1 + 2*x - 3*y + 4*z + t\", \"5*x - y\", \"z - 7*y\"]\n" +
             probes_of("velocity"));
    ASSERT_EQ(u.size(), 9u);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 x = kPlacesM[i];
        EXPECT_NEAR(u[3 * i], 1.0 + 2.0 * x.x - 3.0 * x.y + 4.0 * x.z + 0.1, 1e-5);
        EXPECT_NEAR(u[3 * i + 1], 5.0 * x.x - x.y, 1e-5);
        EXPECT_NEAR(u[3 * i + 2], x.z - 7.0 * x.y, 1e-5);
    }
}

TEST_F(ProbesTest, ReadLinearSmokeAndHeatExactly) {
    const std::vector<double> s =
        read("[smoke]\ninitial = \"1 + 2*x - 3*y + 4*z\"\n[temperature]\ninitial_k = \"100*y - 50*x\"\n" +
             probes_of("smoke") + probes_of("temperature"));
    ASSERT_EQ(s.size(), 6u);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 x = kPlacesM[i];
        EXPECT_NEAR(s[i], 1.0 + 2.0 * x.x - 3.0 * x.y + 4.0 * x.z, 1e-5);
        EXPECT_NEAR(s[3 + i], 100.0 * x.y - 50.0 * x.x, 1e-4);
    }
}

TEST_F(ProbesTest, ReadThePressureUnderWaterAsDeepAsTheyAre) {
    const std::vector<double> p =
        read("[fluid]\ndensity_kg_m3 = 1000\ngravity_m_s2 = [0, -9.81, 0]\n[solver]\ncycles = 12\n" +
             probes_of("pressure"));
    ASSERT_EQ(p.size(), 3u);
    for (const std::size_t i : {1u, 2u}) EXPECT_NEAR(p[i] - p[0], 9810.0 * (0.2 - kPlacesM[i].y), 0.2);
}

TEST_F(ProbesTest, HaveAColumnForEachNumber) {
    const Scene scene =
        read_scene(
            "[smoke]\n[temperature]\n[[probe]]\nname = \"wake\"\nquantity = \"velocity\"\n"
            "point_m = [0.1, 0.1, 0.1]\n[[probe]]\nquantity = \"pressure\"\nfrom_m = [0, 0.1, 0.1]\n"
            "to_m = [0.1, 0.1, 0.1]\npoints = 2\n[[probe]]\nquantity = \"smoke\"\npoint_m = [0.1, 0.1, 0.1]\n"
            "[[probe]]\nquantity = \"temperature\"\npoint_m = [0.1, 0.1, 0.1]\n",
            "s.toml")
            .scene;
    EXPECT_THAT(
        Probes(scene).columns(),
        ElementsAre("wake_velocity_x_m_s", "wake_velocity_y_m_s", "wake_velocity_z_m_s",
                    "probe2_1_pressure_pa", "probe2_2_pressure_pa", "probe3_smoke", "probe4_temperature_k"));
}

TEST_F(ProbesTest, KnowThatTheMethodOf2009KeepsVelocitiesInTheMiddleOfCells) {
    const Scene scene =
        read_scene(
            "[tank]\nsize_m = [0.16, 0.2, 0.12]\ncells = [16, 20, 12]\n[solver]\npreset = \"yang2009\"\n" +
                probes_of("velocity"),
            "s.toml")
            .scene;
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, fluid_setup(scene));
    std::vector<glm::vec3> u;
    for (int z = 0; z < 12; ++z)
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 16; ++x) u.emplace_back(0.01 * glm::dvec3(x + 0.5, y + 0.5, z + 0.5));
    fluid->set_velocity(u);
    const std::vector<double> got = Probes(scene).read(*fluid);
    for (std::size_t i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(got[3 * i + static_cast<std::size_t>(axis)], kPlacesM[i][axis], 1e-6);
}

}  // namespace
}  // namespace eddy
