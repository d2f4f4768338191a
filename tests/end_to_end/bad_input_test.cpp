#include <gtest/gtest.h>

#include <algorithm>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

/// In a folder with some good and some broken files, each bad command line must end with status 2 and one
/// line on standard error that names what is wrong, and leave the folder as it was.
class BadInput : public testing::Test {
  protected:
    const ScratchFolder folder;
    const std::string scene =
        folder.write("scene.toml", "[tank]\nsize_m = [0.16, 0.16, 0.16]\ncells = [16, 16, 16]\n");
    const std::string unknown_key = folder.write("unknown_key.toml", "[tank]\nsise_m = [0.1, 0.1, 0.1]\n");
    const std::string wrong_type = folder.write("wrong_type.toml", "[tank]\ncells = \"many\"\n");
    const std::string broken = folder.write("broken.toml", "[tank\ncells = 3\n");
    const std::string good_motion =
        folder.write("good.csv", "t_s,x_m,y_m,z_m\n0,0,0,0\n0.5,0.01,0,0\n1,0.02,0,0\n");
    const std::string bad_motion = folder.write("bad.csv", "t_s,x_m,y_m,z_m\n0,0,0,0\n0.5,oops,0,0\n");
    const std::string path_scene = folder.write(
        "path.toml",
        "[tank]\ncells = [16, 16, 16]\n[[body]]\nradius_m = 0.02\ncentre_m = [0.08, 0.08, 0.08]\n"
        "motion = \"prescribed\"\npath_csv = \"bad.csv\"\n");
    const std::string missing = folder / "missing";
    const std::string out = folder / "out";

    void expect_refused(const std::vector<std::string>& arguments,
                        const std::vector<std::string>& words) const {
        std::string command = "eddy";
        for (const std::string& argument : arguments) command += " " + argument;
        const std::vector<std::string> before = folder.listing();
        const Ended ended = eddy(arguments);
        EXPECT_EQ(ended.status, 2) << command << "\n" << ended.err;
        EXPECT_EQ(ended.out, "") << command;
        EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << command << "\n" << ended.err;
        for (const std::string& word : words)
            EXPECT_NE(ended.err.find(word), std::string::npos)
                << command << " does not name " << word << ": " << ended.err;
        EXPECT_EQ(folder.listing(), before) << command << " left something behind";
    }
};

TEST_F(BadInput, OnTheCommandLineIsNamed) {
    expect_refused({}, {"subcommand"});
    expect_refused({"dance"}, {"dance"});
    for (const std::string verb : {"run", "simulate", "bench", "check-config", "print-config"})
        expect_refused({verb, "--colour"}, {});
    expect_refused({"run", "--colour", "red"}, {"--colour"});
    expect_refused({"simulate"}, {"SCENE"});
    expect_refused({"check-config"}, {"FILE"});
    expect_refused({"simulate", "rest", "--steps", "3", "--seconds", "1"}, {"--steps", "--seconds"});
    expect_refused({"simulate", "rest", "--steps", "0"}, {"--steps"});
    expect_refused({"simulate", "rest", "--steps", "few"}, {"--steps", "few"});
    expect_refused({"simulate", "rest", "--seconds", "nan"}, {"--seconds", "nan"});
    expect_refused({"run", "--seconds", "-1"}, {"--seconds", "-1"});
    expect_refused({"run", "--seconds", "1e300"}, {"--seconds", "1e300"});
    expect_refused({"run", "--fps", "nan"}, {"--fps", "nan"});
    expect_refused({"run", "--display", "wall"}, {"--display", "wall", "auto|kms|headless"});
    expect_refused({"run", "--haptics", "feet"}, {"--haptics", "feet", "falcon"});
    expect_refused({"run", "--clock", "sundial"}, {"--clock", "sundial", "real|stepped"});
    expect_refused({"run", "--seed", "-3"}, {"--seed", "-3"});
    expect_refused({"run", "--seconds", "1", "--preset-s", "5"}, {"--preset-s 5", "--presets"});
    expect_refused({"bench", "--grid", "3"}, {"--grid", "3"});
    expect_refused({"bench", "--grid", "16,x"}, {"--grid", "x"});
    expect_refused({"bench", "--repeats", "0"}, {"--repeats", "0"});
    expect_refused({"bench", "--csv"}, {"--csv", "--effects"});
    expect_refused({"bench", "--plot", "effects.png"}, {"--plot", "--effects"});
    expect_refused({"bench", "--effects", "--grid", "16,32"}, {"--grid", "--effects", "one grid"});
    expect_refused({"bench", "--effects", "--plot", "effects.jpg"}, {"--plot", "effects.jpg", ".png"});
}

TEST_F(BadInput, InASceneIsNamedWithFileLineAndColumn) {
    for (const std::string verb : {"simulate", "print-config", "check-config"}) {
        expect_refused({verb, unknown_key}, {unknown_key + ":2:1", "sise_m", "size_m"});
        expect_refused({verb, wrong_type}, {wrong_type + ":2:9", "tank.cells"});
        expect_refused({verb, broken}, {broken + ":1:"});
        expect_refused({verb, missing + ".toml"}, {missing + ".toml", "No such file"});
        expect_refused({verb, folder.path().string()}, {folder.path().string(), "folder"});
    }
    for (const std::string verb : {"run", "bench"}) {
        expect_refused({verb, "--scene", unknown_key}, {unknown_key + ":2:1", "sise_m", "size_m"});
        expect_refused({verb, "--scene", missing + ".toml"}, {missing + ".toml", "No such file"});
        expect_refused({verb, "--scene", "jetty"}, {"jetty", "jet"});
    }
    expect_refused({"simulate", "jetty"}, {"jetty", "jet"});
}

TEST_F(BadInput, InAnOverrideIsNamedWithItsKey) {
    for (const std::vector<std::string>& verb :
         {std::vector<std::string>{"simulate", "rest"}, {"run"}, {"bench"}, {"print-config", "rest"}}) {
        const auto with = [&](const std::string& set) {
            std::vector<std::string> arguments = verb;
            arguments.insert(arguments.end(), {"--set", set});
            return arguments;
        };
        expect_refused(with("tank.cels=[16,16,16]"), {"--set", "cels", "cells"});
        expect_refused(with("solver.dt_s=soon"), {"--set", "solver.dt_s"});
        expect_refused(with("solver.dt_s"), {"--set", "key=value"});
    }
    expect_refused({"print-config", "--set", "solver.dt_s=0.01"}, {"--set", "scene"});
}

TEST_F(BadInput, InARecordedMotionIsNamedWithFileAndLine) {
    expect_refused({"run", "--seconds", "1", "--motion", missing}, {"--motion", missing, "No such file"});
    expect_refused({"run", "--seconds", "1", "--motion", bad_motion, "--record", out},
                   {bad_motion + ":3", "oops"});
    expect_refused({"run", "--seconds", "1", "--motion", folder.path().string()}, {folder.path().string()});
    expect_refused({"run", "--seconds", "1", "--motion", good_motion, "--motion-axes", "x,x,z"},
                   {"--motion-axes", "x,x,z"});
    expect_refused({"run", "--seconds", "1", "--motion-axes", "sideways"}, {"--motion-axes", "sideways"});
    expect_refused({"run", "--seconds", "1", "--haptics", "none", "--motion", good_motion},
                   {"--motion", "none"});
    for (const std::string verb : {"simulate", "check-config"})
        expect_refused({verb, path_scene}, {folder / "bad.csv:3", "oops"});
    expect_refused({"simulate", path_scene, "--out", out}, {folder / "bad.csv:3", "oops"});
    expect_refused({"run", "--scene", path_scene, "--record", out}, {folder / "bad.csv:3", "oops"});
    expect_refused({"bench", "--scene", path_scene}, {folder / "bad.csv:3", "oops"});
}

TEST_F(BadInput, AboutAGridNamesTheOptionOnlyWhereItWasGiven) {
    const std::string flat =
        folder.write("flat.toml", "[tank]\nsize_m = [0.32, 0.16, 0.16]\ncells = [32, 16, 16]\n");
    expect_refused({"bench", flat, "--grid", "27"}, {"--grid 27: ", "27 x 13.5 x 13.5"});
    expect_refused({"bench", flat}, {"without --grid, a grid of 25: ", "25 x 12.5 x 12.5"});
    expect_refused({"bench", flat, "--paper", out}, {"without --grid, a grid of 25: "});
    expect_refused({"accuracy", "--sweep", "--case", "A1", "--grid", "25", "--out", out}, {"--grid 25: "});
}

TEST_F(BadInput, AboutTheClockIsNamed) {
    expect_refused({"run", "--clock", "stepped"}, {"--clock stepped", "--seconds"});
    expect_refused({"run", "--clock", "stepped", "--record", out}, {"--seconds"});
    expect_refused({"simulate", "rest", "--seconds", "0.001", "--out", out}, {"--seconds", "0.001", "dt_s"});
}

TEST_F(BadInput, AboutDestinationsIsNamedBeforeAnyWork) {
    const std::string tiny = "tank.cells=[16,16,16]";
    expect_refused({"simulate", "rest", "--steps", "1", "--out", scene}, {"--out", scene, "Not a directory"});
    expect_refused({"simulate", "rest", "--steps", "1", "--out", scene + "/inside"}, {"--out", scene});
    expect_refused({"bench", "--set", tiny, "--grid", "16", "--json", missing + "/bench.json"},
                   {"--json", missing});
    expect_refused({"bench", "--set", tiny, "--grid", "16", "--json", folder.path().string()},
                   {"--json", folder.path().string(), "is a folder"});
    expect_refused({"bench", "--effects", "--plot", missing + "/effects.png"}, {"--plot", missing});
    expect_refused({"run", "--seconds", "1", "--record", scene}, {"--record", scene});
    expect_refused({"run", "--seconds", "1", "--run-dir", scene}, {"--run-dir", scene});
}

TEST_F(BadInput, OfAHandThatCannotBeIsSaidSo) {
    expect_refused({"run", "--haptics", "falcon", "--clock", "stepped", "--seconds", "1", "--record", out},
                   {"--haptics falcon", "--clock stepped"});
}

TEST_F(BadInput, AboutTheFalconIsNamed) {
    expect_refused({"falcon", "--firmware", scene}, {"falcon.firmware", scene, "AA 08"});
    expect_refused({"falcon", "--firmware", missing + "/image.bin"}, {"falcon.firmware", missing});
    const ScratchFolder etc;
    etc.write("exhibit.toml", "[falcon]\nfirmware = \"" + missing + "/settings.bin\"\n");
    expect_refused({"falcon", "--config", etc.path()}, {"falcon.firmware", missing + "/settings.bin"});
    etc.write("exhibit.toml", "[falcon]\nserail = \"F\"\n");
    expect_refused({"falcon", "--config", etc.path()}, {"exhibit.toml:2:1", "nearest valid key: serial"});
    for (const char* verb : {"tune", "screen", "panel", "rt-selftest"})
        expect_refused({verb, "--config", etc.path()}, {"exhibit.toml:2:1", "nearest valid key: serial"});
    expect_refused({"panel", "--code", "blink"}, {"--code", "blink", "degraded"});
    expect_refused({"panel", "--code", "show", "--codes"}, {"--codes", "--code"});
    expect_refused({"falcon", "--seconds", "3", "calibrate"}, {"--seconds", "calibrate"});
}

TEST_F(BadInput, OfAFlightIsNamed) {
    expect_refused({"replay", missing}, {missing, "cannot be read"});
    expect_refused({"replay", scene}, {scene, "is not a flight recording"});
    expect_refused({"replay", folder.write("cut.flight", "eddy flight 3\nversion 0.1.0\n")},
                   {"cut.flight", "is not complete"});
    expect_refused({"replay", scene, "--plot", out + ".jpg"}, {"--plot", ".png"});
    expect_refused({"rt-selftest", "--haptics", "none"}, {"--haptics none"});
    expect_refused({"rt-selftest", "--seconds", "0"}, {"--seconds"});
}

TEST_F(BadInput, ToCheckConfigIsToldFromGoodInput) {
    const Ended good = eddy({"check-config", scene});
    EXPECT_EQ(good.status, 0) << good.err;
    EXPECT_EQ(good.err, "");
    EXPECT_NE(good.out.find("a good scene"), std::string::npos) << good.out;
    const std::string settings = folder.write("exhibit.toml", "scene = \"stir\"\n");
    EXPECT_EQ(eddy({"check-config", settings}).out, settings + ": good exhibit settings\n");
    expect_refused({"check-config", folder.write("bad_exhibit.toml", "scene = \"jetty\"\n")},
                   {"bad_exhibit.toml:1:9", "jetty"});
}

}  // namespace
}  // namespace eddy
