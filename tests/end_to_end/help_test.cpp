#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

struct Verb {
    std::string name;
    std::vector<std::string> says;  // every option and argument
};

const std::vector<Verb> kVerbs{
    {"run",
     {"--scene", "--set", "--display", "--haptics", "--overlay", "--presets", "--preset-s", "--motion",
      "--motion-axes", "--seed", "--seconds", "--record", "--fps", "--clock", "--config", "--run-dir",
      "--state-dir"}},
    {"simulate", {"SCENE", "--set", "--seconds", "--steps", "--out", "--plan"}},
    {"bench",
     {"SCENE", "--scene", "--set", "--grid", "--effects", "--csv", "--plot", "--paper", "--repeats",
      "--json"}},
    {"accuracy",
     {"--validate", "--list", "--case", "--full", "--grid", "--set", "--json", "--csv", "--sweep", "--shard",
      "--merge", "--out"}},
    {"tune", {"SCENE", "--scene", "--set", "--config", "--state-dir", "--show"}},
    {"falcon", {"--firmware", "--serial", "--config", "--seconds", "calibrate"}},
    {"haptics", {"--scene", "--grid", "--quick", "--out"}},
    {"screen", {"--connector", "--config", "--mode"}},
    {"panel", {"--code", "--codes", "--config", "--seconds", "shutting_down"}},
    {"replay", {"FLIGHT", "--plot", ".flight"}},
    {"rt-selftest", {"--seconds", "--haptics", "--config", "--plot", "1.5 ms"}},
    {"check-config", {"FILE"}},
    {"print-config", {"SCENE", "--set", "--origin"}},
};

TEST(Help, OfEachVerbNamesEachOfItsOptions) {
    for (const Verb& verb : kVerbs) {
        const Ended help = eddy({verb.name, "--help"});
        EXPECT_EQ(help.status, 0) << verb.name;
        EXPECT_EQ(help.err, "") << verb.name;
        for (const std::string& word : verb.says)
            EXPECT_NE(help.out.find(word), std::string::npos)
                << verb.name << " --help does not name " << word;
    }
}

TEST(Help, OfTheProgramNamesEachVerb) {
    const Ended help = eddy({"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    for (const Verb& verb : kVerbs)
        EXPECT_NE(help.out.find("  " + verb.name), std::string::npos) << verb.name;
}

TEST(Help, OfAChoiceListsItsWords) {
    const std::string help = eddy({"run", "--help"}).out;
    for (const std::string words :
         {"auto|kms|headless", "auto|falcon|emulated|none", "none|cost", "real|stepped"})
        EXPECT_NE(help.find(words), std::string::npos) << words << " in:\n" << help;
}

TEST(Version, IsOneLineWithWhatItWasBuiltFrom) {
    const Ended version = eddy({"--version"});
    EXPECT_EQ(version.status, 0);
    EXPECT_EQ(version.err, "");
    EXPECT_THAT(version.out, testing::MatchesRegex("eddy " EDDY_VERSION " \\([^ ()]+\\)\n"));
}

}  // namespace
}  // namespace eddy
