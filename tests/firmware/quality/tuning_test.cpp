#include "firmware/quality/tuning.h"

#include <gmock/gmock.h>

#include <cmath>

#include "firmware/input_error.h"
#include "firmware/text_file.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using testing::HasSubstr;

Rung rung(int cells, int cycles, double ms, double p95, double error) {
    return {{SolverPreset::Fast, cells, cycles}, ms, p95, error};
}

Tuning tuning(std::vector<Rung> measured, double budget_ms) {
    Tuning t{
        EDDY_VERSION, "a card", "a machine", "2009-03-01T12:00:00Z", print_scene(load_scene("stir").scene),
        50.0,         4.0,      budget_ms};
    t.measured = std::move(measured);
    choose(t);
    return t;
}

TEST(Tuning, LadderHoldsWhatNothingBeatsInTimeWithoutBeingLessExact) {
    const Tuning t = tuning({rung(64, 2, 90, 95, .008), rung(32, 1, 10, 11, .04), rung(32, 2, 14, 15, .036),
                             rung(24, 3, 12, 13, .06), rung(48, 1, 30, 32, .02), rung(48, 3, 45, 50, .02)},
                            20.0);
    ASSERT_EQ(t.ladder.size(), 4u);
    EXPECT_EQ(t.ladder[0], t.measured[1]);
    EXPECT_EQ(t.ladder[1], t.measured[2]);
    EXPECT_EQ(t.ladder[2], t.measured[4]);
    EXPECT_EQ(t.ladder[3], t.measured[0]);
}

TEST(Tuning, ChosenIsTheMostExactThatKeepsTheBudgetWithItsMargin) {
    const std::vector<Rung> measured{rung(24, 1, 5, 6, .06), rung(32, 2, 14, 15, .036),
                                     rung(48, 1, 30, 32, .02)};
    EXPECT_EQ(tuning(measured, 20.0).chosen, 1u);
    EXPECT_EQ(tuning(measured, 15.0 / kTuningMargin).chosen, 1u);
    EXPECT_EQ(tuning(measured, 14.9 / kTuningMargin).chosen, 0u);
    EXPECT_EQ(tuning(measured, 40.0).chosen, 2u);
}

TEST(Tuning, MachineTooSlowForAnythingGetsTheCheapest) {
    EXPECT_EQ(tuning({rung(24, 1, 50, 60, .06), rung(32, 2, 140, 150, .036)}, 20.0).chosen, 0u);
}

TEST(Tuning, ErrorThatIsNoNumberIsNotALadder) {
    EXPECT_EQ(tuning({rung(24, 1, 5, 6, .06), rung(32, 1, 7, 8, std::nan(""))}, 20.0).ladder.size(), 1u);
}

TEST(Tuning, ReadsBackWhatItWrote) {
    const Tuning t = tuning({rung(24, 1, 5, 6, .06), rung(32, 2, 14, 15, .036)}, 20.0);
    EXPECT_EQ(tuning_from_json(to_json(t), "a file"), t);
}

TEST(Tuning, ReadsBackAnErrorThatIsNoNumber) {
    const Tuning t = tuning({rung(24, 1, 5, 6, .06), rung(32, 2, 14, 15, std::nan(""))}, 20.0);
    const Tuning back = tuning_from_json(to_json(t), "a file");
    EXPECT_TRUE(std::isnan(back.measured.at(1).force_error));
    EXPECT_EQ(back.ladder, t.ladder);
}

TEST(Tuning, ForeignFileIsNamed) {
    const std::string good = to_json(tuning({rung(24, 1, 5, 6, .06)}, 20.0));
    std::string wrong = good;
    wrong.replace(wrong.find("\"fast\""), 6, "\"fest\"");
    std::string beyond = good;
    beyond.replace(beyond.find("\"chosen\": 0"), 11, "\"chosen\": 7");
    Tuning shuffled = tuning({rung(24, 1, 5, 6, .06), rung(32, 2, 14, 15, .03)}, 20.0);
    std::swap(shuffled.ladder[0], shuffled.ladder[1]);
    for (const std::string& foreign :
         {std::string(), std::string("{}"), std::string("[1]"), wrong, beyond, to_json(shuffled)}) {
        try {
            tuning_from_json(foreign, "state/tuning.json");
            FAIL() << foreign;
        } catch (const InputError& e) {
            EXPECT_THAT(e.what(), HasSubstr("state/tuning.json: is not what eddy tune writes")) << foreign;
        }
    }
}

TEST(TuningFile, IsOneForEachSceneAndReadable) {
    const auto name = [](const std::string& scene) { return tuning_file("/state", scene).string(); };
    EXPECT_EQ(name("jet"), "/state/tuning-jet.json");
    EXPECT_EQ(name("stir"), "/state/tuning-stir.json");
    EXPECT_EQ(name("/etc/eddy/scenes/hall_2.toml"), "/state/tuning-hall_2.json");
    EXPECT_EQ(name("Wirbel 3.toml"), "/state/tuning-Wirbel-3.json");
    EXPECT_NE(name("水流.toml"), name("火焰.toml"));
}

TEST(TuningFile, StaysInItsFolderWhateverTheSceneIsCalled) {
    for (const std::string scene : {"validation/B3", "../../etc/passwd", "a/../..toml", "..", "a\nb.toml"}) {
        const std::filesystem::path file = tuning_file("/state", scene);
        EXPECT_EQ(file.parent_path(), "/state") << scene;
        EXPECT_EQ(file.lexically_normal(), file) << scene;
        EXPECT_EQ(file.string().find('\n'), std::string::npos);
    }
}

TEST(StoredTuning, OfOneSceneOutlivesThatOfAnother) {
    const ScratchFolder folder;
    const Tuning t = tuning({rung(24, 1, 5, 6, .06)}, 20.0);
    Tuning other = t;
    other.scene = print_scene(load_scene("jet").scene);
    replace_text_file(tuning_file(folder.path(), "stir"), to_json(t));
    replace_text_file(tuning_file(folder.path(), "jet"), to_json(other));
    std::string trouble;
    EXPECT_TRUE(
        stored_tuning(tuning_file(folder.path(), "stir"), load_scene("stir").scene, "a card", trouble));
    EXPECT_TRUE(stored_tuning(tuning_file(folder.path(), "jet"), load_scene("jet").scene, "a card", trouble));
}

TEST(StoredTuning, CountsOnlyForTheSameProgramRendererAndScene) {
    const ScratchFolder folder;
    const Scene stir = load_scene("stir").scene, jet = load_scene("jet").scene;
    const Tuning t = tuning({rung(24, 1, 5, 6, .06)}, 20.0);
    std::string trouble;
    const std::filesystem::path file = tuning_file(folder.path(), "stir");
    EXPECT_FALSE(stored_tuning(file, stir, "a card", trouble));
    EXPECT_THAT(trouble, HasSubstr("does not exist"));
    replace_text_file(file, to_json(t));
    EXPECT_EQ(stored_tuning(file, stir, "a card", trouble), t);
    EXPECT_FALSE(stored_tuning(file, jet, "a card", trouble));
    EXPECT_THAT(trouble, HasSubstr("another scene"));
    EXPECT_FALSE(stored_tuning(file, stir, "another card", trouble));
    EXPECT_THAT(trouble, HasSubstr("another renderer, a card"));
    Tuning old = t;
    old.version = "0.0.1";
    replace_text_file(file, to_json(old));
    EXPECT_FALSE(stored_tuning(file, stir, "a card", trouble));
    EXPECT_THAT(trouble, HasSubstr("version 0.0.1"));
    replace_text_file(file, "half a fi");
    EXPECT_FALSE(stored_tuning(file, stir, "a card", trouble));
    EXPECT_THAT(trouble, HasSubstr("is not what eddy tune writes"));
}

}  // namespace
}  // namespace eddy
