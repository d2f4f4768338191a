#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/config/complaints.h"
#include "tests/config/whole_schema.h"

namespace eddy {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

const std::string kProbe = "[[probe]]\nquantity = \"velocity\"\n";
const std::string kPoint = "point_m = [0.1, 0.1, 0.1]\n";
const std::string kLine = "from_m = [0.1, 0, 0]\nto_m = [0.1, 0.16, 0]\npoints = 3\n";

TEST(ProbeRules, AProbeIsAPointOrALine) {
    EXPECT_THAT(faults_of(kProbe + kPoint), IsEmpty());
    EXPECT_THAT(faults_of(kProbe + kLine), IsEmpty());
    EXPECT_THAT(faults_of(kProbe), ElementsAre(StartsWith("s.toml:1:1: probe.0: is nowhere")));
    EXPECT_THAT(faults_of(kProbe + "from_m = [0, 0, 0]\nto_m = [0.1, 0, 0]\n"),
                ElementsAre(StartsWith("s.toml:1:1: probe.0.points: is missing here: a line needs")));
    EXPECT_THAT(faults_of(kProbe + kPoint + "points = 4\n"),
                ElementsAre(StartsWith("s.toml:4:10: probe.0.points: is for a line, but point_m is there")));
}

TEST(ProbeRules, ALineIncludesBothItsEnds) {
    const Scene s = read_whole(kProbe + kLine + kProbe + kPoint).scene;
    EXPECT_THAT(s.probes.at(0).places_m(),
                ElementsAre(glm::dvec3(0.1, 0, 0), glm::dvec3(0.1, 0.08, 0), glm::dvec3(0.1, 0.16, 0)));
    EXPECT_THAT(s.probes.at(1).places_m(), ElementsAre(glm::dvec3(0.1)));
    EXPECT_EQ(s.probes.at(1).name, "probe2");
}

TEST(ProbeRules, AProbeIsInTheTank) {
    EXPECT_THAT(faults_of(kProbe + "point_m = [0.1, 0.1, -0.1]\n"),
                ElementsAre(StartsWith("s.toml:3:11: probe.0.point_m: is outside the tank")));
    EXPECT_THAT(faults_of(kProbe + "from_m = [0, 0, 0]\nto_m = [1, 0, 0]\npoints = 3\n"),
                ElementsAre(StartsWith("s.toml:4:8: probe.0.to_m: is outside the tank")));
}

TEST(ProbeRules, TheQuantityIsThere) {
    EXPECT_THAT(faults_of("[[probe]]\n" + kPoint),
                ElementsAre("s.toml:1:1: probe.0.quantity: is missing here: write quantity = a word"));
    EXPECT_THAT(
        faults_of("[[probe]]\nquantity = \"smoke\"\n" + kPoint),
        ElementsAre(StartsWith("s.toml:2:12: probe.0.quantity: there is no smoke to measure: add a table")));
    EXPECT_THAT(faults_of("[[probe]]\nquantity = \"temperature\"\n" + kPoint),
                ElementsAre(StartsWith("s.toml:2:12: probe.0.quantity: there is no temperature to measure")));
    EXPECT_THAT(
        faults_of("[[probe]]\nquantity = \"pressure\"\n" + kPoint + "[imposed]\nvelocity_m_s = [1, 0, 0]\n"),
        ElementsAre(StartsWith("s.toml:2:12: probe.0.quantity: there is no pressure to measure")));
}

TEST(ProbeRules, NamesAreUnique) {
    EXPECT_THAT(faults_of(kProbe + kPoint + "name = \"a\"\n" + kProbe + kPoint + "name = \"a\"\n"),
                ElementsAre(StartsWith("s.toml:8:8: probe.1.name: \"a\" is taken already")));
}

TEST(ProbeRules, ProbesNeedTheSeries) {
    EXPECT_THAT(faults_of(kProbe + kPoint + "[outputs]\nseries = false\n"),
                ElementsAre("s.toml:1:1: probe.0: writes to series.csv, but outputs.series is false"));
}

TEST(OutputRules, FieldsExist) {
    EXPECT_THAT(faults_of("[outputs]\nfields = [\"temperature\"]\n"),
                ElementsAre("s.toml:2:10: outputs.fields: there is no temperature to write: add a table "
                            "[temperature], or remove \"temperature\""));
    EXPECT_THAT(faults_of("[outputs]\nfields = [\"temperature\", \"vorticity\"]\n[temperature]\n"),
                IsEmpty());
    EXPECT_THAT(faults_of("[imposed]\nvelocity_m_s = [1, 0, 0]\n[outputs]\nfields = [\"pressure\"]\n"),
                ElementsAre(StartsWith("s.toml:4:10: outputs.fields: there is no pressure to write")));
}

TEST(OutputRules, ForceMethodsNeedAForceAndASeries) {
    const std::string methods = "[outputs]\nforce_methods = true\n";
    EXPECT_THAT(faults_of(methods + kBody), IsEmpty());
    EXPECT_THAT(faults_of(methods),
                ElementsAre(StartsWith("s.toml:2:17: outputs.force_methods: there is no body")));
    EXPECT_THAT(faults_of(methods + kBody + "force = false\n"),
                ElementsAre(StartsWith("s.toml:2:17: outputs.force_methods: there is no body")));
    EXPECT_THAT(faults_of(methods + "series = false\n" + kBody),
                ElementsAre(StartsWith("s.toml:2:17: outputs.force_methods: writes to series.csv")));
    EXPECT_THAT(faults_of(methods + kBody + "[solver]\npreset = \"yang2009\"\n"),
                ElementsAre(StartsWith("s.toml:2:17: outputs.force_methods: preset = \"yang2009\"")));
}

}  // namespace
}  // namespace eddy
