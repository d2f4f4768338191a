#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

using testing::HasSubstr;

/// A small fluid at 20 steps a second, which any machine can do.
const std::vector<std::string> kSmall{"--set", "tank.cells=[16,16,16]", "--set", "solver.dt_s=0.05",
                                      "--set", "render.width_px=160",   "--set", "render.height_px=120"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

nlohmann::json read_json(const std::string& file) {
    return nlohmann::json::parse(read_all(file));
}

TEST(Tune, TakesSceneAndFolderFromTheExhibitsSettings) {
    const ScratchFolder etc, state;
    etc.write("exhibit.toml", "scene = \"float\"\nstate_dir = \"" + state.path().string() + "\"\n");
    const Ended ended = eddy({"tune", "--show", "--config", etc.path()});
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(ended.err,
              state / "tuning-float.json" + ": there is no tuning of this scene yet; run eddy tune first\n");
}

TEST(Tune, KeepsItsChoiceWithTheEvidenceAndTheExhibitBeginsWithIt) {
    const ScratchFolder state, run;
    // Little time, so that little is tried.
    const std::vector<std::string> quick = with(kSmall, {"--set", "solver.dt_s=0.01"});
    const Ended tuned = eddy(with({"tune", "stir", "--state-dir", state.path()}, quick));
    EXPECT_LE(tuned.status, 1) << tuned.err;  // 1: this machine is too slow for anything
    nlohmann::json tuning = read_json(state / "tuning-stir.json");
    const std::size_t chosen = tuning["chosen"];
    ASSERT_LT(chosen, tuning["ladder"].size());
    EXPECT_GE(tuning["measured"].size(), tuning["ladder"].size());
    for (const auto& rung : tuning["measured"]) {
        EXPECT_GT(rung["step_ms_p50"], 0.0);
        EXPECT_GT(rung["force_error"], 0.0);
        EXPECT_EQ(rung["preset"], "fast");
    }
    for (std::size_t i = 1; i < tuning["ladder"].size(); ++i) {
        EXPECT_GT(tuning["ladder"][i]["step_ms_p50"], tuning["ladder"][i - 1]["step_ms_p50"]);
        EXPECT_LT(tuning["ladder"][i]["force_error"], tuning["ladder"][i - 1]["force_error"]);
    }
    EXPECT_THAT(tuned.out, HasSubstr("> fast "));
    EXPECT_EQ(eddy({"tune", "stir", "--show", "--state-dir", state.path()}).status, 0);

    const Ended ran = eddy(with({"run", "--haptics", "emulated", "--scene", "stir", "--seconds", "1",
                                 "--state-dir", state.path(), "--run-dir", run.path()},
                                quick));
    ASSERT_EQ(ran.status, 0) << ran.err;
    const nlohmann::json cost = read_json(run / "status.json")["cost"];
    if (cost["quality_down"] == 0) {  // it may have been busy
        EXPECT_EQ(cost["cells"][0], tuning["ladder"][chosen]["cells"]);
        EXPECT_EQ(cost["force_error_share"], tuning["ladder"][chosen]["force_error"]);
    }
}

TEST(Tune, MakesTheFolderItKeepsItsResultInAsRunDoes) {
    const ScratchFolder folder;
    const std::vector<std::string> quickest = with(kSmall, {"--set", "solver.dt_s=0.001"});
    const Ended tuned = eddy(with({"tune", "stir", "--state-dir", folder / "a/b"}, quickest));
    EXPECT_LE(tuned.status, 1) << tuned.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "a/b/tuning-stir.json")) << tuned.err;
    const Ended ran = eddy(with({"run", "--haptics", "emulated", "--scene", "stir", "--seconds", "0.1",
                                 "--state-dir", folder / "c/d"},
                                kSmall));
    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_TRUE(std::filesystem::is_directory(folder / "c/d"));
}

TEST(Tune, SaysBeforeAnyWorkThatAFolderCannotBe) {
    const ScratchFolder folder;
    const std::string file = folder.write("file", "");
    const Ended ended = eddy(with({"tune", "stir", "--state-dir", file}, kSmall));
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, HasSubstr("--state-dir: " + file));
}

TEST(Tune, ThatHasNothingToShowSaysWhatToDo) {
    const ScratchFolder state;
    const Ended ended = eddy({"tune", "stir", "--show", "--state-dir", state.path()});
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(ended.err,
              state / "tuning-stir.json" + ": there is no tuning of this scene yet; run eddy tune first\n");
}

TEST(Tune, ShowsWhatIsWrongWithAForeignFile) {
    const ScratchFolder state;
    state.write("tuning-stir.json", "{}");
    const Ended ended = eddy({"tune", "stir", "--show", "--state-dir", state.path()});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, HasSubstr("tuning-stir.json: is not what eddy tune writes"));
}

TEST(Run, WithAForeignTuningSaysSoAndGoesOnWithTheSceneAsItIs) {
    const ScratchFolder state, run;
    state.write("tuning-stir.json", "half a fi");
    const Ended ended = eddy(with({"run", "--haptics", "emulated", "--scene", "stir", "--seconds", "1",
                                   "--state-dir", state.path(), "--run-dir", run.path()},
                                  kSmall));
    ASSERT_EQ(ended.status, 0) << ended.err;
    const nlohmann::json cost = read_json(run / "status.json")["cost"];
    EXPECT_EQ(cost["cells"][0], 16);
    EXPECT_THAT(std::string(cost["quality_note"]), HasSubstr("not tuned: "));
}

TEST(Run, PresetsChangeByThemselvesWhileItGoesOn) {
    const ScratchFolder run;
    const Ended ended =
        eddy(with({"run", "--scene", "stir", "--clock", "stepped", "--seconds", "4", "--presets",
                   "fast,precise,yang2009", "--preset-s", "1", "--run-dir", run.path()},
                  kSmall));
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("precise 16^3, 3 cycles from now on"));
    EXPECT_THAT(ended.err, HasSubstr("yang2009 16^3, 40 sweeps from now on"));
    EXPECT_THAT(ended.err, HasSubstr("fast 16^3, 2 cycles from now on"));
    EXPECT_EQ(read_json(run / "status.json")["haptics"]["not_finite"], 0);
}

TEST(Run, RefusesAPresetThatCannotDoTheScene) {
    const Ended ended = eddy(
        {"run", "--haptics", "emulated", "--scene", "float", "--seconds", "1", "--presets", "fast,yang2009"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, HasSubstr("is not in the method of Yang et al. 2009"));
}

TEST(Run, RestsWhenNothingMoves) {
    const ScratchFolder run;
    const Ended ended = eddy(with({"run", "--scene", "stir", "--haptics", "none", "--clock", "stepped",
                                   "--seconds", "20", "--run-dir", run.path()},
                                  kSmall));
    ASSERT_EQ(ended.status, 0) << ended.err;
    const nlohmann::json fluid = read_json(run / "status.json")["fluid"];
    EXPECT_GT(fluid["rested"], 200);  // of 400 updates
    EXPECT_LT(fluid["steps"], 200);
}

}  // namespace
}  // namespace eddy
