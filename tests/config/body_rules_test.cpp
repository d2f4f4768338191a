#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/config/whole_schema.h"

namespace eddy {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

std::string body(const std::string& keys) {
    return "[[body]]\ncentre_m = [0.08, 0.08, 0.08]\n" + keys;
}
const std::string kBall = body("radius_m = 0.01\n");

TEST(BodyRules, EachShapeNeedsItsOwnSizes) {
    for (const std::string keys :
         {"radius_m = 0.01", "shape = \"box\"\nsize_m = [0.01, 0.02, 0.03]",
          "shape = \"capsule\"\nradius_m = 0.01\nlength_m = 0.02",
          "shape = \"cylinder\"\nradius_m = 0.01\nlength_m = 0.02",
          "shape = \"torus\"\nradius_m = 0.01\ntube_radius_m = 0.002",
          "shape = \"ellipsoid\"\nradii_m = [0.01, 0.02, 0.03]",
          "shape = \"disk\"\nradius_m = 0.01\nthickness_m = 0.002",
          "shape = \"paddle\"\nblade_m = [0.01, 0.02, 0.003]\nhandle_radius_m = 0.01\nhandle_length_m = 0.02",
          "shape = \"tetrahedron\"\nedge_m = 0.01"})
        EXPECT_THAT(faults_of(body(keys)), IsEmpty()) << keys;
    EXPECT_THAT(
        faults_of(body("shape = \"disk\"\nradius_m = 0.01\n")),
        ElementsAre("s.toml:1:1: body.0.thickness_m: is missing here: shape = \"disk\" needs thickness_m = a "
                    "number"));
    EXPECT_THAT(
        faults_of(body("shape = \"paddle\"\nblade_m = [0.01, 0.02, 0.003]\n")),
        ElementsAre(StartsWith("s.toml:1:1: body.0.handle_radius_m: is missing here: shape = \"paddle\""),
                    StartsWith("s.toml:1:1: body.0.handle_length_m: is missing here")));
}

TEST(BodyRules, SizesOfAnotherShapeAreRefused) {
    EXPECT_THAT(
        faults_of(kBall + "length_m = 0.02\n"),
        ElementsAre("s.toml:4:12: body.0.length_m: is not for shape = \"sphere\", which has radius_m"));
    EXPECT_THAT(
        faults_of(body("shape = \"capsule\"\nradius_m = 0.01\nlength_m = 0.1\nscale = 2")),
        ElementsAre(
            "s.toml:6:9: body.0.scale: is not for shape = \"capsule\", which has radius_m, length_m"));
    EXPECT_THAT(faults_of(body("shape = \"bal\"\nlength_m = 0.02")), ElementsAre(StartsWith("s.toml:3:9: ")));
}

TEST(BodyRules, ATorusHasAHole) {
    EXPECT_THAT(
        faults_of(body("shape = \"torus\"\nradius_m = 0.01\ntube_radius_m = 0.01\n")),
        ElementsAre(StartsWith("s.toml:5:17: body.0.tube_radius_m: must be less than radius_m = 0.01")));
}

TEST(BodyRules, AMeshFileIsFoundBeforeAnythingRuns) {
    EXPECT_THAT(faults_of(body("shape = \"mesh\"\nfile = \"nowhere.stl\"\n")),
                ElementsAre(StartsWith("s.toml:4:8: body.0.file: there is no file \"/")));
}

TEST(BodyRules, AxesHaveADirection) {
    EXPECT_THAT(faults_of(kBall + "axis = [0, 0, 0]\n"),
                ElementsAre(StartsWith("s.toml:4:8: body.0.axis: [0, 0, 0] is no direction")));
    EXPECT_THAT(faults_of(kBall + "motion = \"prescribed\"\noscillation = { frequency_hz = 1, angle_deg = 9, "
                                  "axis = [0, 0, 0] }\n"),
                ElementsAre(StartsWith("s.toml:5:57: body.0.oscillation.axis: ")));
}

TEST(BodyRules, OrientationTurnsAboutTheAxisByTheAngle) {
    const Scene::Body b = read_whole(kBall + "axis = [0, 0, 7]\nangle_deg = 90\n").scene.bodies.at(0);
    EXPECT_LT(glm::distance(b.orientation() * glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)), 1e-15);
    EXPECT_EQ(read_whole(kBall).scene.bodies.at(0).orientation() * glm::dvec3(1, 2, 3), glm::dvec3(1, 2, 3));
}

TEST(BodyRules, OscillationsSwingOrTurnAndDoNotFightTheSpin) {
    const std::string prescribed = kBall + "motion = \"prescribed\"\n";
    EXPECT_THAT(faults_of(prescribed + "oscillation = { frequency_hz = 1, angle_deg = 9 }\n"), IsEmpty());
    EXPECT_THAT(faults_of(prescribed + "oscillation = { frequency_hz = 1 }\n"),
                ElementsAre(StartsWith("s.toml:5:15: body.0.oscillation: does nothing")));
    EXPECT_THAT(
        faults_of(prescribed + "spin_rad_s = [1, 0, 0]\noscillation = { frequency_hz = 1, angle_deg = 9 }\n"),
        ElementsAre(StartsWith("s.toml:6:47: body.0.oscillation.angle_deg: a body with spin_rad_s")));
}

TEST(BodyRules, FreeBodiesHaveADensityAndFixedOnesDoNot) {
    EXPECT_THAT(faults_of(kBall + "motion = \"free\"\ndensity_kg_m3 = 1000\n"), IsEmpty());
    EXPECT_THAT(faults_of(kBall + "motion = \"free\"\n"),
                ElementsAre("s.toml:1:1: body.0.density_kg_m3: is missing here: motion = \"free\" needs "
                            "density_kg_m3 = a number"));
    EXPECT_THAT(
        faults_of(kBall + "density_kg_m3 = 1000\n"),
        ElementsAre("s.toml:4:17: body.0.density_kg_m3: is for motion = \"free\" and for turning = true, "
                    "but motion is \"fixed\""));
}

TEST(BodyRules, TurningBodiesMayHaveADensity) {
    const std::string box = "shape = \"box\"\nsize_m = [0.01, 0.02, 0.03]\nmotion = \"held\"\n";
    EXPECT_THAT(faults_of(body(box + "turning = true\ndensity_kg_m3 = 1000\n")), IsEmpty());
    EXPECT_THAT(faults_of(body(box + "density_kg_m3 = 1000\n")),
                ElementsAre(StartsWith("s.toml:6:17: body.0.density_kg_m3: is for motion")));
}

TEST(BodyRules, FreeBodiesStartInTheTank) {
    EXPECT_THAT(faults_of("[[body]]\nradius_m = 0.1\ncentre_m = [0.2, 0, 0]\nmotion = \"free\"\n"
                          "density_kg_m3 = 1000\n"),
                ElementsAre(StartsWith("s.toml:3:12: body.0.centre_m: is outside the tank")));
}

TEST(BodyRules, FixedBodiesReachTheTankWithTheirWholeShape) {
    const std::string outside =
        "[[body]]\ncentre_m = [0.08, 0.2, 0.08]\nshape = \"cylinder\"\nradius_m = 0.01\n";
    EXPECT_THAT(faults_of(outside + "length_m = 0.081\n"), IsEmpty());
    EXPECT_THAT(faults_of(outside + "length_m = 0.07\n"),
                ElementsAre(StartsWith("s.toml:2:12: body.0.centre_m: is outside the tank")));
}

TEST(BodyRules, ContainersAreFixedOrPrescribed) {
    const std::string shell = "radius_m = 0.07\ninside_out = true\n";
    EXPECT_THAT(faults_of(body(shell)), IsEmpty());
    EXPECT_THAT(faults_of(body(shell + "motion = \"prescribed\"\n")), IsEmpty());
    EXPECT_THAT(faults_of(body(shell + "motion = \"held\"\n")),
                ElementsAre(StartsWith("s.toml:4:14: body.0.inside_out: a container is")));
    EXPECT_THAT(faults_of(body(shell + "motion = \"free\"\ndensity_kg_m3 = 1\n")),
                ElementsAre(StartsWith("s.toml:4:14: body.0.inside_out: a container is")));
}

TEST(BodyRules, OnlyHeldBodiesThatAreNotRoundTurnInTheHand) {
    const std::string box = "shape = \"box\"\nsize_m = [0.01, 0.02, 0.03]\nturning = true\n";
    EXPECT_THAT(faults_of(body(box + "motion = \"held\"\n")), IsEmpty());
    EXPECT_THAT(faults_of(body(box)),
                ElementsAre(StartsWith("s.toml:5:11: body.0.turning: is for motion = ")));
    EXPECT_THAT(faults_of(kBall + "motion = \"held\"\nturning = true\n"),
                ElementsAre(StartsWith("s.toml:5:11: body.0.turning: is for shapes that are not round")));
}

}  // namespace
}  // namespace eddy
