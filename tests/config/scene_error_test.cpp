#include <gmock/gmock.h>

#include <gtest/gtest.h>
#include <algorithm>

#include "config/scene.h"
#include "tests/config/complaints.h"
#include "tests/config/everything.h"

// Each mistake in a scene file is reported where it stands, with its key, its cause and its cure.

namespace eddy {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::vector<std::string> complaints_about(const std::string& text) {
    return complaints([&] { read_scene(text, "s.toml"); });
}

TEST(SceneError, UnknownKeyNamesTheNearest) {
    EXPECT_THAT(complaints_about("[solver]\n  dt = 0.01\n"),
                ElementsAre("s.toml:2:3: solver.dt: unknown key; nearest valid key: dt_s"));
    EXPECT_THAT(complaints_about("[tnak]\ncells = [64, 64, 64]\n"),
                ElementsAre("s.toml:1:2: tnak: unknown key; nearest valid key: tank"));
}

TEST(SceneError, KeyUnlikeAnyOtherShowsTheChoice) {
    EXPECT_THAT(
        complaints_about("[forcing]\nacceleration_m_s2 = [0, 0, 0]\ncolour = 1\n"),
        Contains("s.toml:3:1: forcing.colour: unknown key; nearest valid key: acceleration_m_s2; valid here: "
                 "acceleration_m_s2"));
}

TEST(SceneError, UnknownKeyInAListOfTablesCountsFromZero) {
    EXPECT_THAT(complaints_about("[[body]]\nradius_m = 0.01\ncentre_m = [0.1, 0.1, 0.1]\n"
                                 "[[body]]\nradius = 1\nradius_m = 0.01\ncentre_m = [0.1, 0.1, 0.1]\n"),
                ElementsAre("s.toml:5:1: body.1.radius: unknown key; nearest valid key: radius_m"));
}

TEST(SceneError, WrongTypeSaysWhatWasExpectedAndFound) {
    EXPECT_THAT(complaints_about("title = 3"),
                ElementsAre("s.toml:1:9: title: expected text, found the whole number 3"));
    EXPECT_THAT(complaints_about("[solver]\ndt_s = \"fast\""),
                ElementsAre("s.toml:2:8: solver.dt_s: expected a number, found the text \"fast\""));
    EXPECT_THAT(complaints_about("[solver]\ncycles = 2.5"),
                ElementsAre("s.toml:2:10: solver.cycles: expected a whole number, found the number 2.5"));
    EXPECT_THAT(complaints_about("[outputs]\nseries = 1"),
                ElementsAre("s.toml:2:10: outputs.series: expected true or false, found the whole number 1"));
    EXPECT_THAT(complaints_about("tank = true"),
                ElementsAre("s.toml:1:8: tank: expected a table, found true"));
    EXPECT_THAT(complaints_about("title = 2009-03-18"),
                ElementsAre("s.toml:1:9: title: expected text, found a date or time"));
}

TEST(SceneError, VectorsHaveThreeComponents) {
    EXPECT_THAT(complaints_about("[tank]\nsize_m = [0.16, 0.16]"),
                ElementsAre("s.toml:2:10: tank.size_m: expected a list of 3 numbers, found a list of 2"));
    EXPECT_THAT(complaints_about("[tank]\ncells = [64, 64, \"64\"]"),
                ElementsAre("s.toml:2:18: tank.cells.2: expected a whole number, found the text \"64\""));
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

// What no hand writes is refused before anything goes through it: a key of thirty thousand names took all of the stack.
TEST(SceneError, KeyOfManyNamesIsRefused) {
    const std::string deep = repeated("a.", 30'000) + "a = 1\n";
    EXPECT_THAT(complaints_about("title = \"x\"\n" + deep),
                ElementsAre("s.toml:2:1: a key has more than 16 names with dots between"));
    EXPECT_THAT(complaints_about("[" + repeated("'#'.", 30'000) + "a]\n"),
                ElementsAre("s.toml:1:1: a key has more than 16 names with dots between"));
    EXPECT_THAT(complaints_about("tank = {" + repeated("\"a = b\" . ", 30'000) + "a = 1}\n"),
                ElementsAre("s.toml:1:1: a key has more than 16 names with dots between"));
}

TEST(SceneError, DotsInTextsNumbersAndRemarksAreNoNames) {
    const std::string dots(100, '.');
    EXPECT_THAT(complaints_about("# " + dots + "\ntitle = \"\\\"" + dots + "\"\n"), IsEmpty());
    EXPECT_THAT(complaints_about("title = '" + dots + "'\n"), IsEmpty());
    EXPECT_THAT(complaints_about("title = \"\"\"\n\"" + dots + "\"\"\"\n"), IsEmpty());
    EXPECT_THAT(complaints_about("x = [" + repeated("0.5, ", 100) + "0.5]\n"),
                ElementsAre(HasSubstr("x: unknown key")));
}

TEST(SceneError, ListOfThousandsIsRefused) {
    EXPECT_THAT(complaints_about(repeated("[[body]]\nradius_m = 0.01\n", 10'000)),
                ElementsAre(EndsWith("10000 entries; at most 1000 can be")));
    EXPECT_THAT(complaints_about(repeated("[[body]]\nx = [" + repeated("1,", 99) + "1]\n", 300)),
                ElementsAre(EndsWith("more than 20000 values in one file")));
}

TEST(SceneError, OfThousandsOfMistakesAHundredAreTold) {
    std::string text;
    for (int i = 0; i < 900; ++i) text += "x" + std::to_string(i) + " = 1\n";
    const auto all = complaints_about(text);
    ASSERT_EQ(all.size(), 101u);
    EXPECT_THAT(all.front(), StartsWith("s.toml:1:1: x0: unknown key"));
    EXPECT_THAT(all.back(), EndsWith("and 800 more that are wrong"));
}

TEST(SceneError, SingleBracketsAroundAListAreCaught) {
    EXPECT_THAT(
        complaints_about("[body]\nradius_m = 0.01"),
        ElementsAre("s.toml:1:1: body: expected a list of tables, each under [[body]], found a table"));
}

TEST(SceneError, OutOfRangeSaysTheRange) {
    EXPECT_THAT(complaints_about("[solver]\ndt_s = 0.0"),
                ElementsAre("s.toml:2:8: solver.dt_s: 0 is out of range: must be above 0 and at most 1"));
    EXPECT_THAT(
        complaints_about("[tank]\ncells = [64, 3, 64]"),
        ElementsAre("s.toml:2:14: tank.cells.1: 3 is out of range: must be at least 4 and at most 512"));
    EXPECT_THAT(
        complaints_about("[haptics]\nmax_force_n = 8.01"),
        ElementsAre(
            "s.toml:2:15: haptics.max_force_n: 8.01 is out of range: must be at least 0 and at most 8"));
}

TEST(SceneError, NumbersMustBeFinite) {
    EXPECT_THAT(complaints_about("[initial]\nvelocity_m_s = [0, nan, -inf]"),
                ElementsAre("s.toml:2:20: initial.velocity_m_s.1: nan is not a finite number",
                            "s.toml:2:25: initial.velocity_m_s.2: -inf is not a finite number"));
}

TEST(SceneError, WrongWordListsTheValidOnesNearestFirst) {
    EXPECT_THAT(
        complaints_about("[solver]\npreset = \"yang\""),
        ElementsAre("s.toml:2:10: solver.preset: \"yang\" is no word for this key; valid, nearest first: "
                    "\"fast\", \"yang2009\", \"precise\""));
    EXPECT_THAT(
        complaints_about("[outputs]\nfields = [\"velocity\", \"presure\"]"),
        ElementsAre(
            "s.toml:2:23: outputs.fields.1: \"presure\" is no word for this key; valid, nearest first: "
            "\"pressure\", \"smoke\", \"temperature\", \"velocity\", \"vorticity\""));
    EXPECT_THAT(
        complaints_about("[tank]\nwalls = \"slap\""),
        ElementsAre(
            "s.toml:2:9: tank.walls: \"slap\" is no word for this key; valid, nearest first: \"slip\", "
            "\"no_slip\", \"open\", \"inflow\""));
    EXPECT_THAT(complaints_about("[tank]\nwalls = { y_low = \"slip\", y_hig = \"slip\" }"),
                ElementsAre("s.toml:2:27: tank.walls.y_hig: unknown key; nearest valid key: y_high"));
}

TEST(SceneError, MissingKeyPointsAtItsTable) {
    EXPECT_THAT(
        complaints_about("\n[[body]]\ncentre_m = [0.1, 0.1, 0.1]"),
        ElementsAre(
            "s.toml:2:1: body.0.radius_m: is missing here: shape = \"sphere\" needs radius_m = a number"));
    EXPECT_THAT(
        complaints_about("\n[[body]]\nradius_m = 0.01"),
        ElementsAre("s.toml:2:1: body.0.centre_m: is missing here: write centre_m = a list of 3 numbers"));
}

TEST(SceneError, SyntaxErrorsLookTheSame) {
    const auto lines = complaints_about("title = \"Jet\"\n[tank\ncells = 3\n");
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_THAT(lines[0], StartsWith("s.toml:2:6: "));
    EXPECT_THAT(complaints_about("title = \"a\"\ntitle = \"b\"\n"), ElementsAre(StartsWith("s.toml:2:")));
}

// toml++ 3.3 aborts on these when its assertions are on.
TEST(SceneError, HeaderWithoutAKeyIsASyntaxErrorInEveryBuild) {
    for (const std::string text : {"[=]", "[[=]]", "[#", "[\n]", "[.a]"})
        EXPECT_THAT(complaints_about(text), ElementsAre(StartsWith("s.toml:1:"))) << text;
}

// toml++ tells the compiler that this cannot happen; the asan preset shows whether it believes it.
TEST(SceneError, LettersBeyondAsciiOutsideQuotesAreASyntaxError) {
    for (const std::string letter :
         {"\xc3\xa9", "\xe1\x9a\xa0", "\xe2\xa0\x80", "\xe3\x80\x81", "\xef\xbb\xbe"})
        for (const std::string text : {" = 1", "title", "title = ", "title = \"a\" ", "[tank"})
            EXPECT_THAT(complaints_about(text + letter), ElementsAre(StartsWith("s.toml:1:"))) << text;
    EXPECT_EQ(read_scene("title = \"\"\"\\\n \xc3\xa9\"\"\"", "s.toml").scene.title, "\xc3\xa9");
}

TEST(SceneError, AllMistakesComeInOneGoInTheOrderOfTheFile) {
    const std::string text =
        "titel = \"x\"\n"
        "[tank]\n"
        "cells = [64, 64, 6400]\n"
        "[[body]]\n"
        "motion = \"hold\"\n"
        "radius_m = -1\n"
        "[solver]\n"
        "dt_s = true\n";
    EXPECT_THAT(
        complaints_about(text),
        ElementsAre(
            HasSubstr("s.toml:1:1: titel: unknown key; nearest valid key: title"),
            HasSubstr("s.toml:3:18: tank.cells.2: 6400 is out of range"),
            HasSubstr("s.toml:5:10: body.0.motion: \"hold\" is no word for this key; valid, nearest first: "
                      "\"held\""),
            HasSubstr("s.toml:6:12: body.0.radius_m: -1 is out of range"),
            HasSubstr("s.toml:8:8: solver.dt_s: expected a number, found true")));
}

TEST(SceneError, TextOfTheErrorHasOneLineForEach) {
    try {
        read_scene("a = 1\n\"b\\nc\" = 2\n", "s.toml");
        FAIL() << "loaded";
    } catch (const ConfigError& error) {
        const std::string what = error.what();
        EXPECT_EQ(std::count(what.begin(), what.end(), '\n'), 1) << what;
        EXPECT_THAT(what, HasSubstr("s.toml:2:1: b\\u000ac: unknown key"));
    }
}

TEST(SceneError, CellsMustBeCubes) {
    EXPECT_THAT(
        complaints_about("[tank]\nsize_m = [0.16, 0.16, 0.2]\ncells = [64, 64, 64]"),
        ElementsAre(
            "s.toml:2:10: tank.size_m: cells must be cubes, but are 0.0025 x 0.0025 x 0.003125 m; nearest "
            "size_m that is right: [0.173333, 0.173333, 0.173333]"));
    EXPECT_THAT(complaints_about("[tank]\ncells = [64, 64, 32]"),
                ElementsAre(StartsWith("s.toml:2:9: tank.cells: ")));
}

TEST(SceneError, CellsMayDifferByOnePartInTenThousand) {
    EXPECT_THAT(complaints_about("[tank]\nsize_m = [0.1, 0.2, 0.100009]\ncells = [32, 64, 32]"), IsEmpty());
    EXPECT_THAT(complaints_about("[tank]\nsize_m = [0.1, 0.2, 0.100011]\ncells = [32, 64, 32]"),
                ElementsAre(HasSubstr("cubes")));
}

TEST(SceneError, SuggestedTankSizeIsAccepted) {
    const std::string cells = "[tank]\ncells = [48, 31, 77]\nsize_m = ";
    const std::string line = complaints_about(cells + "[0.3, 0.21, 0.52]").at(0);
    EXPECT_THAT(complaints_about(cells + line.substr(line.rfind('['))), IsEmpty()) << line;
}

const std::string kSource = "[[source]]\ncentre_m = [0.08, 0.08, 0.08]\nradius_m = 0.01\n";

TEST(SceneError, SmokeSourceNeedsTheSmokeEffect) {
    EXPECT_THAT(complaints_about(kSource + "smoke_per_s = 1\n"),
                ElementsAre(StartsWith(
                    "s.toml:4:15: source.0.smoke_per_s: needs the smoke effect: add a table [smoke]")));
    EXPECT_THAT(complaints_about(kSource + "smoke_per_s = 1\n[smoke]\n"), IsEmpty());
    EXPECT_THAT(complaints_about("[outputs]\nfields = [\"smoke\"]"),
                ElementsAre(StartsWith("s.toml:2:10: outputs.fields: ")));
}

TEST(SceneError, SourceMustDoSomethingSometimeSomewhere) {
    EXPECT_THAT(complaints_about(kSource), ElementsAre(StartsWith("s.toml:1:1: source.0: does nothing")));
    EXPECT_THAT(complaints_about(kSource + "velocity_m_s = [1, 0, 0]\nstart_s = 2\nstop_s = 1\n"),
                ElementsAre("s.toml:6:10: source.0.stop_s: must be after start_s = 2"));
    EXPECT_THAT(complaints_about("[[source]]\ncentre_m = [2, 0, 0]\nradius_m = 1\nvelocity_m_s = [1, 0, 0]"),
                ElementsAre(StartsWith("s.toml:2:12: source.0.centre_m: is outside the tank")));
}

TEST(SceneError, NamesAreUniqueAndPlain) {
    EXPECT_THAT(
        complaints_about(kBody + "name = \"ball\"\n" + kBody + "name = \"ball\"\n"),
        ElementsAre("s.toml:8:8: body.1.name: \"ball\" is taken already: each must have its own name"));
    EXPECT_THAT(complaints_about(kBody + "name = \"body2\"\n" + kBody),
                ElementsAre(HasSubstr("body.1.name: \"body2\" is taken")));
    EXPECT_THAT(complaints_about(kBody + "name = \"1.5\"\n"),
                ElementsAre(HasSubstr("body.0.name: \"1.5\" is no name")));
    EXPECT_THAT(
        complaints_about(kBody + "name = \"x\"\n" + kSource + "name = \"x\"\nvelocity_m_s = [1, 0, 0]"),
        IsEmpty());
}

TEST(SceneError, OneHandHoldsOneBody) {
    const std::string held = "[[body]]\nradius_m = 0.01\nmotion = \"held\"\n";
    EXPECT_THAT(complaints_about(held), IsEmpty());
    EXPECT_THAT(complaints_about(held + held),
                ElementsAre(StartsWith("s.toml:6:10: body.1.motion: a second held body")));
}

TEST(SceneError, OnlyPrescribedBodiesHaveAMotion) {
    EXPECT_THAT(complaints_about(kBody + "motion = \"prescribed\"\nvelocity_m_s = [1, 0, 0]\n"), IsEmpty());
    EXPECT_THAT(
        complaints_about(kBody + "velocity_m_s = [1, 0, 0]\n"),
        ElementsAre(
            "s.toml:4:16: body.0.velocity_m_s: is for motion = \"prescribed\", but motion is \"fixed\""));
    EXPECT_THAT(complaints_about(kBody + "oscillation = { amplitude_m = [0, 0, 1], frequency_hz = 1 }\n"),
                ElementsAre(StartsWith("s.toml:4:15: body.0.oscillation: is for motion")));
}

TEST(SceneError, SolverKeysBelongToTheirPreset) {
    EXPECT_THAT(
        complaints_about("[solver]\njacobi_sweeps = 40"),
        ElementsAre(
            "s.toml:2:17: solver.jacobi_sweeps: is for preset = \"yang2009\", but preset is \"fast\""));
    EXPECT_THAT(complaints_about("[solver]\ncycles = 2\npreset = \"yang2009\""),
                ElementsAre(StartsWith("s.toml:2:10: solver.cycles")));
    EXPECT_THAT(complaints_about("[solver]\njacobi_sweeps = 40\npreset = \"yang2009\""), IsEmpty());
}

TEST(SceneError, TheMethodOf2009MovesNoBodies) {
    const std::string yang = "[solver]\npreset = \"yang2009\"\n";
    EXPECT_THAT(complaints_about(yang + kBody + "motion = \"free\"\ndensity_kg_m3 = 1\n"),
                ElementsAre(StartsWith("s.toml:6:10: body.0.motion: is not in the method of Yang")));
    EXPECT_THAT(complaints_about(yang + "[[body]]\nshape = \"box\"\nsize_m = [0.1, 0.1, 0.1]\nmotion = "
                                        "\"held\"\nturning = true\n"),
                ElementsAre(StartsWith("s.toml:7:11: body.0.turning: is not in the method of Yang")));
}

// While there is anything that a scene may say but the solver cannot do.
TEST(SceneError, WhatThisVersionCannotDoIsRefusedByName) {
    for (const std::string& text : scenes_with_every_key(testing::TempDir() + "eddy_not_yet")) {
        EXPECT_THAT(complaints_about(text), Each(EndsWith(": not in this version of eddy")));
    }
    EXPECT_THAT(complaints_about("[fluid]\nviscosity_pa_s = 0\n[solver]\ntime_order = 2\n"), IsEmpty());
    EXPECT_THAT(complaints_about("[fluid]\nviscosity_pa_s = 0.1\n[solver]\ntime_order = 2\n"),
                ElementsAre("s.toml:4:14: solver.time_order: not in this version of eddy"));
}

TEST(SceneError, MissingPathFileIsFoundBeforeAnythingRuns) {
    EXPECT_THAT(complaints_about(kBody + "motion = \"prescribed\"\npath_csv = \"nowhere.csv\"\n"),
                ElementsAre(StartsWith("s.toml:5:12: body.0.path_csv: there is no file \"/")));
}

TEST(SceneError, UnknownSceneNameShowsTheShippedOnes) {
    const auto lines = complaints([] { load_scene("jt"); });
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_THAT(lines[0],
                StartsWith("jt: no shipped scene has this name; shipped, nearest first: \"jet\", "));
    for (const std::string_view name : shipped_scenes()) EXPECT_THAT(lines[0], HasSubstr(std::string(name)));
}

TEST(SceneError, UnknownValidationSceneShowsTheOthers) {
    EXPECT_THAT(
        complaints([] { load_scene("validation/A12"); }),
        ElementsAre(StartsWith("validation/A12: no shipped scene has this name; shipped, nearest first: "
                               "\"validation/A1")));
}

TEST(SceneError, UnreadableFileSaysWhy) {
    EXPECT_THAT(complaints([] { load_scene("no/such/scene.toml"); }),
                ElementsAre("no/such/scene.toml: cannot be read: No such file or directory"));
    EXPECT_THAT(complaints([] { load_scene("/tmp/"); }),
                ElementsAre("/tmp/: cannot be read: it is a folder"));
}

}  // namespace
}  // namespace eddy
