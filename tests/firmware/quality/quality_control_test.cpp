#include "firmware/quality/quality_control.h"

#include <gmock/gmock.h>

#include "firmware/text_file.h"
#include "tests/firmware/quality/small_tank.h"
#include "tests/gles/gl_fixture.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr Seconds kPeriod{0.02}, kNothing{0.0};
constexpr std::uint8_t kRight = 1, kNone = 0;

constexpr Quality fast(int cells, int cycles) {
    return {SolverPreset::Fast, cells, cycles};
}

class QualityControlTest : public gles::GlTest {
  protected:
    /// As if this machine had been tuned: four settings, of which the third keeps 50 steps a second.
    void keep_a_tuning() const {
        Tuning tuning{EDDY_VERSION,
                      gpu.capabilities().renderer,
                      "a machine",
                      "2009-03-01T12:00:00Z",
                      print_scene(scene),
                      50.0,
                      1.0,
                      19.0};
        tuning.measured = {{fast(13, 1), 4.0, 5.0, 0.08},
                           {fast(13, 2), 8.0, 9.0, 0.06},
                           {fast(26, 1), 14.0, 15.0, 0.04},
                           {fast(26, 2), 30.0, 33.0, 0.02},
                           {fast(26, 3), 45.0, 47.0, 0.01}};
        choose(tuning);
        replace_text_file(file, to_json(tuning));
    }
    QualityControl control() { return {gpu, scene, {{}, kNothing, file}}; }

    /// A show that goes on for so long; all changes of quality in it.
    std::vector<QualityControl::Change> show(QualityControl& control, Seconds length, Seconds interval,
                                             Seconds elsewhere = kNothing, long steps = 1) {
        std::vector<QualityControl::Change> changes;
        for (const Instant end = now + std::chrono::duration_cast<Instant>(length); now < end;) {
            now += std::chrono::duration_cast<Instant>(interval);
            if (auto change = control.update(now, {interval, elsewhere, steps}, kNone))
                changes.push_back(std::move(*change));
        }
        return changes;
    }

    /// Works until it says something.
    static std::string next_words(QualityControl& control) {
        for (int pieces = 0; pieces < 10000; ++pieces)
            if (const auto text = control.work()) return *text;
        return "";
    }

    const ScratchFolder folder;
    std::filesystem::path file = folder / "tuning-test.json";
    Scene scene = small_tank();
    Instant now{0};
};

TEST_F(QualityControlTest, WithNothingToGoByKeepsTheSceneAsItIsWritten) {
    QualityControl control(gpu, scene, {});
    EXPECT_EQ(control.first(), fast(13, 2));
    EXPECT_THAT(control.all(), ElementsAre(fast(13, 2)));
    EXPECT_TRUE(show(control, Seconds(10.0), 5 * kPeriod).empty());
    EXPECT_FALSE(control.work());
    EXPECT_EQ(control.note(), "");
}

TEST_F(QualityControlTest, BeginsWithWhatTheMachineWasTunedToAndMayClimbOneAboveIt) {
    keep_a_tuning();
    QualityControl control = this->control();
    EXPECT_EQ(control.first(), fast(26, 1));
    EXPECT_THAT(control.all(), ElementsAre(fast(13, 1), fast(13, 2), fast(26, 1), fast(26, 2)));
    EXPECT_EQ(control.force_error(fast(13, 2)), 0.06);
    EXPECT_FALSE(control.force_error(fast(64, 2)));
    EXPECT_FALSE(control.work()) << "there is nothing to find out";
    EXPECT_TRUE(show(control, Seconds(10.0), kPeriod).empty());
}

TEST_F(QualityControlTest, TakesTheQualityDownWhenTheShowIsLateAndUpAgain) {
    keep_a_tuning();
    QualityControl control = this->control();
    show(control, Seconds(3.0), kPeriod);
    const auto down = show(control, Seconds(2.0), 1.5 * kPeriod);
    ASSERT_EQ(down.size(), 1u);
    EXPECT_EQ(down[0].quality, fast(13, 2));
    EXPECT_EQ(down[0].reason, "steps took 30 ms, 20 are allowed");
    EXPECT_EQ(control.note(), down[0].reason);
    EXPECT_EQ(control.steps_down(), 1);
    EXPECT_EQ(control.first(), fast(13, 2)) << "where it is now";

    std::vector<QualityControl::Change> up;
    for (int second = 0; second < 60 && up.empty(); ++second) {
        control.step_took(8.0);
        up = show(control, Seconds(1.0), kPeriod);
    }
    ASSERT_EQ(up.size(), 1u);
    EXPECT_EQ(up[0].quality, fast(26, 1));
    EXPECT_EQ(control.steps_up(), 1);
}

TEST_F(QualityControlTest, DoesNotBlameTheFluidForWhatPicturesMadeLate) {
    keep_a_tuning();
    QualityControl control = this->control();
    // Steps of 14 ms, and a picture of 25 ms after each: 39 ms, twice what is allowed.
    EXPECT_TRUE(show(control, Seconds(60.0), Seconds(0.039), Seconds(0.025)).empty());
    EXPECT_EQ(control.steps_down(), 0);
    // Steps of 30 ms are too slow whatever is drawn besides.
    EXPECT_EQ(show(control, Seconds(3.0), Seconds(0.055), Seconds(0.025)).size(), 1u);
}

TEST_F(QualityControlTest, DoesNotTakeStepsThatMakeUpForADelayForSlowOnes) {
    keep_a_tuning();
    QualityControl control = this->control();
    EXPECT_TRUE(show(control, Seconds(60.0), Seconds(0.042), kNothing, 3).empty()) << "14 ms each";
    EXPECT_EQ(show(control, Seconds(3.0), Seconds(0.09), kNothing, 3).size(), 1u) << "30 ms each";
}

TEST_F(QualityControlTest, TunesInTheQuietAndGoesOnWithWhatItFound) {
    QualityControl control = this->control();
    EXPECT_EQ(control.note(), "not tuned: " + file.string() + " does not exist");
    gpu.free_idle_textures();
    const std::size_t before = gpu.textures().bytes();
    EXPECT_EQ(next_words(control),
              "tuning this machine while nobody is here, as " + file.string() + " does not exist");
    EXPECT_FALSE(show(control, Seconds(1.0), 2 * kPeriod).size()) << "nothing governs meanwhile";
    EXPECT_EQ(control.note(), "tuning: trying fast 13^3, 1 cycle");
    EXPECT_THAT(next_words(control), StartsWith("tuned: fast 13^3, "));
    EXPECT_EQ(control.note(), "");
    EXPECT_EQ(gpu.textures().bytes(), before) << "the textures of what was tried are free again";

    const Tuning kept = tuning_from_json(read_text_file(file), file);
    const auto changes = show(control, 3 * kPeriod, kPeriod);
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0].quality, kept.ladder.at(kept.chosen).quality);
    EXPECT_EQ(changes[0].reason, "this machine has been tuned");
    EXPECT_EQ(control.force_error(changes[0].quality), kept.ladder.at(kept.chosen).force_error);
    EXPECT_EQ(this->control().first(), changes[0].quality) << "the next start begins with it";
    EXPECT_FALSE(control.work()) << "tuned once";
}

TEST_F(QualityControlTest, ThatCannotKeepItsTuningSaysSoAndUsesIt) {
    file = folder / "gone/tuning-test.json";  // its folder was there when the show began
    QualityControl control = this->control();
    next_words(control);
    const std::string text = next_words(control);
    EXPECT_THAT(text, StartsWith("tuned: fast 13^3, "));
    EXPECT_THAT(text, HasSubstr("; not kept for the next start: " + file.string() + ": cannot be created"));
    EXPECT_EQ(show(control, 3 * kPeriod, kPeriod).size(), 1u);
}

TEST_F(QualityControlTest, ThatCannotTuneGivesUpInWordsAndTheShowGoesOn) {
    scene.bodies.at(0).shape = BodyShape::Mesh;
    scene.bodies.at(0).file = "/nowhere/absent.obj";  // it was there when the show began
    QualityControl control = this->control();
    const std::string text = next_words(control);
    EXPECT_THAT(text, StartsWith("measuring was given up until the next start: "));
    EXPECT_THAT(text, HasSubstr("/nowhere/absent.obj"));
    EXPECT_THAT(control.note(), StartsWith("measuring was given up: "));
    for (int i = 0; i < 10; ++i) EXPECT_FALSE(control.work()) << "it would fail again";
    EXPECT_TRUE(show(control, Seconds(5.0), 2 * kPeriod).empty());
    EXPECT_EQ(control.first(), quality_of(scene));
}

class PresetsOfVisitors : public QualityControlTest {
  protected:
    QualityControl control() {
        return {gpu, scene, {{SolverPreset::Fast, SolverPreset::Yang2009}, kNothing, file}};
    }
};

TEST_F(PresetsOfVisitors, FollowTheButtonsAndNoTuning) {
    keep_a_tuning();
    QualityControl control = this->control();
    const Quality yang{SolverPreset::Yang2009, 13, 40};
    EXPECT_THAT(control.all(), ElementsAre(fast(13, 2), yang));
    EXPECT_TRUE(show(control, Seconds(10.0), 3 * kPeriod).empty()) << "nothing governs what a visitor chose";
    const auto change = control.update(now += 20ms, {kPeriod}, kRight);
    ASSERT_TRUE(change);
    EXPECT_EQ(change->quality, yang);
}

TEST_F(PresetsOfVisitors, AreMeasuredInTheQuiet) {
    QualityControl control = this->control();
    gpu.free_idle_textures();
    const std::size_t before = gpu.textures().bytes();
    for (const Quality& quality : control.all()) {
        EXPECT_FALSE(control.force_error(quality));
        for (int pieces = 0; pieces < 1000 && !control.force_error(quality); ++pieces)
            EXPECT_FALSE(control.work());
        EXPECT_GT(control.force_error(quality).value_or(0.0), 0.0) << describe(quality);
        EXPECT_EQ(gpu.textures().bytes(), before);
    }
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(PresetsOfVisitors, ThatCannotBeMeasuredAreShownAllTheSame) {
    scene.bodies.at(0).shape = BodyShape::Mesh;
    scene.bodies.at(0).file = "/nowhere/absent.obj";
    QualityControl control = this->control();
    EXPECT_THAT(next_words(control), HasSubstr("/nowhere/absent.obj"));
    for (int i = 0; i < 10; ++i) EXPECT_FALSE(control.work());
    EXPECT_FALSE(control.force_error(fast(13, 2)));
    EXPECT_THAT(control.note(), StartsWith("measuring was given up: "));
    EXPECT_TRUE(control.update(20ms, {kPeriod}, kRight));
}

}  // namespace
}  // namespace eddy
