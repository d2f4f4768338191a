#include "firmware/exhibit/config_intake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "config/sha256.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kScene = "title = \"hall\"\n[tank]\ncells = [16, 16, 16]\n";

/// A machine: it can be started, cut off and started again; time passes only when a test says so.
class Exhibits : public testing::Test {
  protected:
    Exhibits() {
        for (const char* folder : {"eddy", "eddy/conf.d", "state", "run"})
            std::filesystem::create_directory(scratch_.path() / folder);
    }

    void write(const std::string& name, const std::string& text) { scratch_.write("eddy/" + name, text); }

    ConfigOffer start(bool accept = true) {
        intake_.reset();
        intake_.emplace(ConfigIntake::Setup{.folder = scratch_.path() / "eddy",
                                            .state_dir = scratch_.path() / "state",
                                            .run_dir = scratch_.path() / "run",
                                            .orders = orders_,
                                            .factory_only = safe_mode_,
                                            .boot = std::to_string(boot_)});
        ConfigOffer offer = intake_->start();
        if (accept) intake_->accepted(offer.hash, now_);
        return offer;
    }
    void crash() { intake_.reset(); }
    void cut_power() {
        intake_.reset();
        ++boot_;
    }

    std::optional<ConfigOffer> pass(Instant time) {
        for (const Instant end = now_ + time; now_ < end;) {
            now_ += 50ms;
            do {
                if (auto offer = intake_->poll(now_)) return offer;
                if (intake_->busy()) std::this_thread::sleep_for(1ms);
            } while (intake_->busy());
            if (auto offer = intake_->poll(now_)) return offer;
        }
        return std::nullopt;
    }
    /// Whatever comes within a second is taken.
    std::optional<ConfigOffer> take() {
        auto offer = pass(1s);
        if (offer) intake_->accepted(offer->hash, now_);
        return offer;
    }
    nlohmann::json answer() const {
        return nlohmann::json::parse(read_all(scratch_.path() / "run/status/config.json"));
    }

    const ScratchFolder scratch_;
    SceneOrders orders_;
    bool safe_mode_ = false;
    int boot_ = 1;
    Instant now_{0s};
    std::optional<ConfigIntake> intake_;
};

TEST_F(Exhibits, RunTheFactorysSettingsWithoutAnyFile) {
    const ConfigOffer offer = start();
    EXPECT_EQ(offer.exhibit, Exhibit{});
    EXPECT_EQ(offer.source, ConfigSource::Factory);
    EXPECT_FALSE(pass(60s));
    EXPECT_EQ(answer()["source"], "factory");
    EXPECT_EQ(answer()["result"], "applied");
    EXPECT_EQ(answer()["hash"], kFactoryHash);
}

TEST_F(Exhibits, TakeANewFileOnceItWasQuietForAQuarterOfASecond) {
    start();
    write("exhibit.toml", "max_force_n = 2\n");
    EXPECT_FALSE(pass(200ms));
    write("exhibit.toml", "max_force_n = 3\n");
    EXPECT_FALSE(pass(250ms));
    const auto offer = pass(100ms);
    ASSERT_TRUE(offer);
    EXPECT_EQ(offer->exhibit.max_force_n, 3.0);
    EXPECT_THAT(offer->changes, ElementsAre(KeyChange{"max_force_n", TakesEffect::Live, "4", "3"}));
    EXPECT_FALSE(offer->needs_new_scene());
    EXPECT_EQ(answer()["result"], "trying");
    intake_->accepted(offer->hash, now_);
    EXPECT_EQ(answer()["result"], "applied");
    EXPECT_EQ(answer()["source"], "new");
    EXPECT_EQ(answer()["running_hash"], offer->hash);
    EXPECT_EQ(answer()["probation"], true);
    EXPECT_FALSE(pass(20s));
}

TEST_F(Exhibits, DoNotNoticeAFileThatIsWrittenAnewWithTheSameContent) {
    write("exhibit.toml", "max_force_n = 2\n");
    start();
    write("exhibit.toml", "max_force_n = 2\n");
    EXPECT_FALSE(pass(20s));
    EXPECT_EQ(intake_->report().applied, 1u);
}

TEST_F(Exhibits, GoOnWhateverIsWrongAndSayAllOfIt) {
    start();
    write("exhibit.toml", "scen = \"jet\"\nmax_force_n = 99\n");
    write("conf.d/10.toml", "display = \n");
    EXPECT_FALSE(take());
    const nlohmann::json said = answer();
    EXPECT_EQ(said["result"], "refused");
    EXPECT_EQ(said["source"], "factory");
    ASSERT_EQ(said["errors"].size(), 3u);
    const nlohmann::json& unknown = said["errors"][1];
    EXPECT_EQ(unknown["file"], scratch_ / "eddy/exhibit.toml");
    EXPECT_EQ(unknown["line"], 1);
    EXPECT_EQ(unknown["column"], 1);
    EXPECT_EQ(unknown["key"], "scen");
    EXPECT_EQ(unknown["message"], "unknown key");
    EXPECT_EQ(unknown["hint"], "nearest valid key: scene");
    write("exhibit.toml", "max_force_n = 3\n");
    write("conf.d/10.toml", "# nothing\n");
    EXPECT_TRUE(take());
    EXPECT_THAT(answer()["errors"], IsEmpty());
}

TEST_F(Exhibits, AreNotStoppedByAnyPieceOfAFile) {
    write("exhibit.toml", "# ours\n");
    start();
    const std::string whole = "scene = \"stir\"\nmax_force_n = 2\n[falcon]\nserial = \"F\"\n";
    for (std::size_t length = 0; length < whole.size(); ++length) {
        write("exhibit.toml", whole.substr(0, length));
        const auto offer = pass(400ms);
        // Only what ends with a line is whole as far as anybody can see.
        EXPECT_EQ(offer.has_value(), length > 0 && whole[length - 1] == '\n') << whole.substr(0, length);
        if (offer) intake_->refused(offer->hash, "not in this test");
    }
}

TEST_F(Exhibits, WaitForTheFileThatItsSumTellsOf) {
    write("exhibit.toml", "# ours\n");
    start();
    const std::string whole = "scene = \"stir\"\nmax_force_n = 2\n";
    write("exhibit.toml.sha256", sha256(whole) + "  exhibit.toml\n");
    EXPECT_FALSE(take());
    for (std::size_t length = 0; length < whole.size(); ++length) {
        write("exhibit.toml", whole.substr(0, length));
        EXPECT_FALSE(pass(400ms)) << length;
    }
    write("exhibit.toml", whole);
    EXPECT_TRUE(take());
}

TEST_F(Exhibits, ReadTheSceneFileAndWhatItNamesFromTheFolder) {
    std::filesystem::create_directory(scratch_.path() / "eddy/scenes");
    write("scenes/hall.toml", kScene);
    write("exhibit.toml", "scene = \"scenes/hall.toml\"\n");
    EXPECT_EQ(start().scene.scene.title, "hall");
    write("scenes/hall.toml", std::string(kScene) + "[fluid]\nviscosity_pa_s = -1\n");
    EXPECT_FALSE(take());
    EXPECT_EQ(answer()["errors"][0]["key"], "fluid.viscosity_pa_s");
    write("scenes/hall.toml", std::string(kScene) + "[fluid]\nviscosity_pa_s = 1\n");
    const auto offer = take();
    ASSERT_TRUE(offer);
    EXPECT_EQ(offer->scene.scene.fluid.viscosity_pa_s, 1.0);
    EXPECT_TRUE(offer->needs_new_scene());
    std::filesystem::remove(scratch_.path() / "eddy/scenes/hall.toml");
    EXPECT_FALSE(take());
    EXPECT_EQ(answer()["result"], "refused");
}

TEST_F(Exhibits, RefusePresetsThatTheSceneCannotDo) {
    write("exhibit.toml", "# ours\n");
    start();
    write("scene.toml", std::string(kScene) + "[temperature]\n");
    write("exhibit.toml", "scene = \"scene.toml\"\npresets = [\"fast\", \"yang2009\"]\n");
    EXPECT_FALSE(take());
    ASSERT_FALSE(answer()["errors"].empty());
    EXPECT_EQ(answer()["errors"][0]["key"], "presets");
    EXPECT_EQ(answer()["errors"][0]["file"], scratch_ / "eddy/exhibit.toml");
}

TEST_F(Exhibits, RefuseASceneThatThePresetsOfTheCommandLineCannotDo) {
    orders_.presets = {SolverPreset::Fast, SolverPreset::Yang2009};
    write("exhibit.toml", "# ours\n");
    EXPECT_EQ(start().source, ConfigSource::New);
    write("scene.toml", std::string(kScene) + "[temperature]\n");
    write("exhibit.toml", "scene = \"scene.toml\"\n");
    EXPECT_FALSE(take());
    ASSERT_FALSE(answer()["errors"].empty());
    EXPECT_EQ(answer()["errors"][0]["file"], "--presets");
}

TEST_F(Exhibits, TellWhichKeysWaitForARestartAndDoNotApplyThem) {
    write("exhibit.toml", "max_force_n = 3\n");
    start();
    write("exhibit.toml", "max_force_n = 2\nhaptics = \"none\"\n[falcon]\nserial = \"F\"\n");
    const auto offer = take();
    ASSERT_TRUE(offer);
    EXPECT_EQ(offer->exhibit.max_force_n, 2.0);
    EXPECT_EQ(offer->exhibit.haptics, HapticsChoice::Auto);
    EXPECT_EQ(offer->exhibit.falcon.serial, "");
    ASSERT_EQ(answer()["pending_restart"].size(), 2u);
    EXPECT_EQ(answer()["pending_restart"][0]["key"], "haptics");
    EXPECT_EQ(answer()["pending_restart"][0]["takes_effect"], "process");
    pass(31s);
    intake_->stopped();
    EXPECT_EQ(start().exhibit.haptics, HapticsChoice::None);
    EXPECT_THAT(answer()["pending_restart"], IsEmpty());
    EXPECT_EQ(answer()["probation"], true) << "only a start with them proves them";
}

TEST_F(Exhibits, StayAsTheyAreWhenASceneCannotBeBuilt) {
    write("exhibit.toml", "# ours\n");
    start();
    write("exhibit.toml", "scene = \"stir\"\n");
    const auto offer = pass(1s);
    ASSERT_TRUE(offer);
    write("exhibit.toml", "scene = \"rest\"\n");
    EXPECT_FALSE(pass(1s)) << "one at a time";
    intake_->refused(offer->hash, "the grid does not fit into this GPU");
    EXPECT_EQ(answer()["result"], "refused");
    EXPECT_EQ(answer()["errors"][0]["message"], "the grid does not fit into this GPU");
    const auto next = take();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->exhibit.scene, "rest");
    write("exhibit.toml", "scene = \"stir\"\n");
    EXPECT_FALSE(take()) << "it was tried";
    EXPECT_EQ(answer()["result"], "refused");
    write("exhibit.toml", "scene = \"rest\"\n");
    EXPECT_FALSE(take()) << "it runs";
    EXPECT_EQ(answer()["result"], "applied");
}

TEST_F(Exhibits, ComeUpWithTheLastGoodOneAfterTheyDiedUnderANewOne) {
    write("exhibit.toml", "max_force_n = 3\n");
    start();
    pass(31s);
    EXPECT_EQ(answer()["probation"], false);
    write("exhibit.toml", "max_force_n = 2\n");
    ASSERT_TRUE(take());
    pass(29s);
    crash();
    const ConfigOffer offer = start();
    EXPECT_EQ(offer.exhibit.max_force_n, 3.0);
    EXPECT_EQ(offer.source, ConfigSource::LastGood);
    EXPECT_EQ(answer()["source"], "last-good");
    EXPECT_EQ(answer()["result"], "black-listed");
    write("exhibit.toml", "max_force_n = 2\n");
    EXPECT_FALSE(take());
    crash();
    EXPECT_EQ(start().exhibit.max_force_n, 3.0) << "still";
    write("exhibit.toml", "max_force_n = 2.5\n");
    EXPECT_EQ(take()->exhibit.max_force_n, 2.5);
    crash();
    write("exhibit.toml", "max_force_n = 3\n");
    EXPECT_EQ(start().source, ConfigSource::New);
    EXPECT_EQ(answer()["probation"], false) << "it is the last good one";
}

TEST_F(Exhibits, BlameADeathWhileAConfigurationIsBuiltOnThat) {
    write("exhibit.toml", "max_force_n = 3\n");
    start();  // on probation itself
    write("exhibit.toml", "scene = \"stir\"\n");
    const auto built = pass(1s);
    ASSERT_TRUE(built);
    intake_->building(built->hash);
    crash();
    EXPECT_NE(start().hash, built->hash);
    EXPECT_EQ(answer()["result"], "black-listed");
    write("exhibit.toml", "max_force_n = 3\n");
    EXPECT_TRUE(take()) << "the one before did nothing";
}

TEST_F(Exhibits, BlameADeathWhileTheFirstIsBuiltOnThat) {
    write("exhibit.toml", "max_force_n = 3\n");
    const std::string hash = start(false).hash;
    intake_->building(hash);
    crash();
    EXPECT_EQ(start().source, ConfigSource::Factory);
    EXPECT_EQ(answer()["result"], "black-listed");
}

TEST_F(Exhibits, BlameNoDeathOnAConfigurationThatWasRefusedOrEndedWell) {
    start();
    write("exhibit.toml", "scene = \"stir\"\n");
    const std::string hash = pass(1s).value().hash;
    intake_->building(hash);
    intake_->refused(hash, "the grid does not fit into this GPU");
    crash();
    EXPECT_EQ(start(false).hash, hash) << "it may be tried again: on another GPU, perhaps";
    intake_->building(hash);
    intake_->stopped();
    crash();
    EXPECT_EQ(start(false).hash, hash);
    intake_->building(hash);
    cut_power();
    EXPECT_EQ(start(false).hash, hash) << "a power cut is no proof";
}

TEST_F(Exhibits, BlameTheRunningOneAgainWhenAnotherWasRefused) {
    write("exhibit.toml", "max_force_n = 3\n");
    const std::string running = start().hash;
    write("exhibit.toml", "scene = \"stir\"\n");
    const std::string refused = pass(1s).value().hash;
    intake_->building(refused);
    intake_->refused(refused, "no");
    crash();
    write("exhibit.toml", "max_force_n = 3\n");
    EXPECT_EQ(start().source, ConfigSource::Factory) << "it died in its first seconds";
    EXPECT_EQ(answer()["result"], "black-listed");
    EXPECT_EQ(answer()["hash"], running);
}

TEST_F(Exhibits, ComeUpWithTheFactorysWhenNothingElseIsGood) {
    write("exhibit.toml", "max_force_n = 3\n");
    start();
    crash();
    EXPECT_EQ(start().source, ConfigSource::Factory);
    write("exhibit.toml", "max_force_n = \n");
    crash();
    EXPECT_EQ(start().exhibit, Exhibit{});
    EXPECT_EQ(answer()["result"], "refused");
}

TEST_F(Exhibits, DoNotCondemnAConfigurationForAPowerCutNorForAnOrderlyEnd) {
    write("exhibit.toml", "max_force_n = 3\n");
    start();
    cut_power();
    EXPECT_EQ(start().source, ConfigSource::New);
    intake_->stopped();
    crash();
    EXPECT_EQ(start().source, ConfigSource::New);
}

TEST_F(Exhibits, FallBackWhenTheirBuilderRefusesAtTheStart) {
    write("exhibit.toml", "max_force_n = 3\n");
    start();
    pass(31s);
    write("exhibit.toml", "max_force_n = 2\n");
    crash();
    ConfigOffer offer = start(false);
    EXPECT_EQ(offer.exhibit.max_force_n, 2.0);
    intake_->refused(offer.hash, "no");
    offer = intake_->start();
    EXPECT_EQ(offer.source, ConfigSource::LastGood);
    intake_->refused(offer.hash, "no");
    offer = intake_->start();
    EXPECT_EQ(offer.source, ConfigSource::Factory);
    intake_->refused(offer.hash, "no");
    EXPECT_THROW(intake_->start(), ConfigError);
}

TEST_F(Exhibits, LetANewerFileOvertakeWhatIsBeingBuiltForTheStart) {
    write("exhibit.toml", "max_force_n = 3\nhaptics = \"none\"\n");
    const ConfigOffer first = start(false);
    intake_->building(first.hash);
    write("exhibit.toml", "max_force_n = 2\nhaptics = \"none\"\n");
    const auto second = pass(1s);
    ASSERT_TRUE(second);
    EXPECT_THAT(second->changes, ElementsAre(KeyChange{"max_force_n", TakesEffect::Live, "3", "2"}));
    intake_->building(second->hash);
    write("exhibit.toml", "max_force_n = 1\nscene = \"stir\"\nhaptics = \"emulated\"\n");
    const auto third = pass(1s);
    ASSERT_TRUE(third);
    EXPECT_TRUE(third->needs_new_scene());
    EXPECT_EQ(third->exhibit.haptics, HapticsChoice::None) << "it was opened with that";
    intake_->accepted(first.hash, now_);
    EXPECT_EQ(answer()["running_hash"], "") << "nobody builds that any more";
    intake_->accepted(third->hash, now_);
    EXPECT_EQ(answer()["running_hash"], third->hash);
    EXPECT_EQ(answer()["result"], "applied");
    ASSERT_EQ(answer()["pending_restart"].size(), 1u);
    EXPECT_EQ(answer()["pending_restart"][0]["key"], "haptics");
}

TEST_F(Exhibits, OvertakenBeforeAnythingIsBuiltKeepWhatWasOpened) {
    write("exhibit.toml", "haptics = \"none\"\n");
    start(false);
    write("exhibit.toml", "haptics = \"emulated\"\n");
    const auto second = pass(1s);
    ASSERT_TRUE(second);
    intake_->building(second->hash);
    EXPECT_EQ(second->exhibit.haptics, HapticsChoice::None) << "it was opened with that";
    intake_->accepted(second->hash, now_);
    EXPECT_EQ(answer()["pending_restart"].size(), 1u);
}

TEST_F(Exhibits, BuildOnWhenWhatOvertakesCannotBeUsed) {
    write("exhibit.toml", "max_force_n = 3\n");
    const ConfigOffer first = start(false);
    intake_->building(first.hash);
    write("exhibit.toml", "scene = \"stir\"\n");
    const auto second = pass(1s);
    ASSERT_TRUE(second);
    intake_->refused(second->hash, "no run can do that");
    EXPECT_EQ(answer()["errors"][0]["message"], "no run can do that");
    write("exhibit.toml", "max_force_n = \n");
    EXPECT_FALSE(pass(1s));
    EXPECT_EQ(answer()["result"], "refused");
    intake_->accepted(first.hash, now_);
    EXPECT_EQ(answer()["running_hash"], first.hash);
    EXPECT_EQ(answer()["result"], "refused") << "what lies there now";
    write("exhibit.toml", "max_force_n = 3\n");
    EXPECT_FALSE(pass(1s)) << "it runs";
    EXPECT_EQ(answer()["result"], "applied");
}

TEST_F(Exhibits, DoNotBeginAnewWhenWhatIsBeingBuiltIsBack) {
    write("exhibit.toml", "max_force_n = 3\n");
    const ConfigOffer first = start(false);
    intake_->building(first.hash);
    std::filesystem::remove(scratch_.path() / "eddy/exhibit.toml");
    EXPECT_FALSE(pass(1s));
    EXPECT_EQ(answer()["result"], "refused");
    write("exhibit.toml", "max_force_n = 3\n");
    EXPECT_FALSE(pass(1s));
    EXPECT_EQ(answer()["result"], "trying");
    EXPECT_THAT(answer()["errors"], IsEmpty());
    intake_->accepted(first.hash, now_);
    EXPECT_EQ(answer()["result"], "applied");
}

TEST_F(Exhibits, KeepTheirShowWhenTheFolderIsGone) {
    write("exhibit.toml", "max_force_n = 3\n");
    start();
    pass(31s);
    std::filesystem::rename(scratch_.path() / "eddy", scratch_.path() / "unmounted");
    EXPECT_FALSE(take());
    EXPECT_EQ(answer()["result"], "refused");
    crash();
    EXPECT_EQ(start().source, ConfigSource::LastGood);
    std::filesystem::rename(scratch_.path() / "unmounted", scratch_.path() / "eddy");
    ASSERT_TRUE(take());
    EXPECT_EQ(answer()["source"], "new");
    EXPECT_EQ(answer()["result"], "applied");
}

TEST_F(Exhibits, KeepTheirOwnSettingsWhenOnlyThoseOfTheFleetAreLeft) {
    write("exhibit.toml", "max_force_n = 1.5\n");
    write("conf.d/hours.toml", "[unattended]\nidle_after_s = 90\n");
    start();
    pass(31s);
    std::filesystem::remove(scratch_.path() / "eddy/exhibit.toml");
    EXPECT_FALSE(take());
    EXPECT_EQ(answer()["result"], "refused");
    EXPECT_THAT(answer()["errors"][0]["message"].get<std::string>(), HasSubstr("exhibit.toml is not here"));
    crash();
    const ConfigOffer offer = start();
    EXPECT_EQ(offer.source, ConfigSource::LastGood);
    EXPECT_EQ(offer.exhibit.max_force_n, 1.5);
    write("exhibit.toml", "# nothing\n");
    ASSERT_TRUE(take());
    EXPECT_EQ(answer()["result"], "applied") << "it was meant so";
}

TEST_F(Exhibits, WithSettingsOfTheFleetAloneNeedNoneOfTheirOwn) {
    write("conf.d/hours.toml", "max_force_n = 2\n");
    EXPECT_EQ(start().source, ConfigSource::New);
    pass(31s);
    write("conf.d/hours.toml", "max_force_n = 1\n");
    ASSERT_TRUE(take());
    EXPECT_EQ(answer()["result"], "applied");
}

TEST_F(Exhibits, AnswerBesideTheSettingsToo) {
    std::filesystem::create_directory(scratch_.path() / "eddy/status");
    start();
    write("exhibit.toml", "max_force_n = 99\n");
    EXPECT_FALSE(take());
    EXPECT_EQ(read_all(scratch_.path() / "eddy/status/config.json"),
              read_all(scratch_.path() / "run/status/config.json"));
    const auto answers = intake_->report().refused;
    EXPECT_FALSE(pass(20s));
    EXPECT_EQ(intake_->report().refused, answers) << "an answer is no new configuration";
}

TEST_F(Exhibits, ThrowWhatIsWrongOnTheCommandLine) {
    write("exhibit.toml", "max_force_n = 3\n");
    orders_.set = {"solver.dt_s=-1"};
    EXPECT_THROW(start(), ConfigError);
    orders_ = {"sitr", {}};
    EXPECT_THROW(start(), ConfigError);
    orders_ = {"stir", {"solver.dt_s=0.01"}};
    EXPECT_EQ(start().scene.scene.solver.dt_s, 0.01);
}

TEST_F(Exhibits, OfferAGoodFileWithinASecondOfItsLastByteAndPollInNoTime) {
    write("exhibit.toml", "# ours\n");
    start();
    const RealClock clock;
    write("exhibit.toml", "max_force_n = 2\n");
    std::vector<double> poll_ms;
    std::optional<ConfigOffer> offer;
    while (!offer && clock.now() < 5s) {
        const Instant before = clock.now();
        offer = intake_->poll(before);
        poll_ms.push_back(Seconds(clock.now() - before).count() * 1e3);
        std::this_thread::sleep_for(5ms);
    }
    ASSERT_TRUE(offer);
    const double offered_ms = Seconds(clock.now()).count() * 1e3;
    const Instant before = clock.now();
    intake_->accepted(offer->hash, before);
    const double accepted_ms = Seconds(clock.now() - before).count() * 1e3;
    std::sort(poll_ms.begin(), poll_ms.end());
    std::printf(
        "offered after %.0f ms, accepted in %.1f ms; a poll takes %.4f ms (median), %.2f ms (worst of %zu)\n",
        offered_ms, accepted_ms, poll_ms[poll_ms.size() / 2], poll_ms.back(), poll_ms.size());
    EXPECT_LT(offered_ms, 1000.0);
    EXPECT_LT(poll_ms[poll_ms.size() / 2], 1.0);
}

TEST_F(Exhibits, SayWhenTheFactorysStandInForThoseOfTheOwner) {
    const auto stands_in = [&] { return answer()["stands_in"].get<bool>(); };
    start();
    EXPECT_FALSE(stands_in()) << "there are no others";
    write("exhibit.toml", "max_force_n = \n");
    start(false);
    EXPECT_TRUE(intake_->report().stands_in) << "from the first moment";
    start();
    EXPECT_TRUE(stands_in());
    write("exhibit.toml", "# the factory's, as the owner wants\n");
    ASSERT_TRUE(take());
    EXPECT_FALSE(stands_in());
    safe_mode_ = true;
    start();
    EXPECT_TRUE(intake_->report().stands_in) << "nobody has looked for others";
}

// The last good settings would give force beside a stop contact that was wired since, and that nobody reads.
TEST_F(Exhibits, SayWhenTheLastGoodOnesDoNotReadTheStopThatTheNewOnesName) {
    const auto fall_back = [&](const std::string& good, const std::string& bad) {
        std::filesystem::remove_all(scratch_.path() / "state/config");
        write("exhibit.toml", good);
        start();
        pass(31s);
        crash();
        write("exhibit.toml", bad);
        start();
        EXPECT_EQ(answer()["source"], "last-good") << bad;
        EXPECT_EQ(answer()["stands_in"], false) << bad;
        return answer()["stop_unread"].get<bool>();
    };
    const std::string plain = "max_force_n = 3\n", wired = plain + "[gpio]\nbutton = \"B\"\nstop = \"S\"\n";
    EXPECT_TRUE(fall_back(plain, "scene = \"nowhere\"\n[gpio]\nbutton = \"B\"\nstop = \"S\"\n"));
    EXPECT_TRUE(fall_back(plain, "scene = \n[gpio]\nbutton = \"B\"\n  stop= 'S' # new\n")) << "no TOML";
    EXPECT_TRUE(fall_back(wired, "scene = \"nowhere\"\n[gpio]\nbutton = \"B\"\nstop = \"S2\"\n"));
    EXPECT_TRUE(fall_back(
        wired, "scene = \"nowhere\"\n[gpio]\nbutton = \"B\"\nstop = \"S\"\nstop_active_low = true\n"));
    EXPECT_FALSE(
        fall_back(plain, "scene = \n[gpio]\nstop = \"\" # none\nstop_active_low = false\n# stop = \"S\"\n"));
    EXPECT_FALSE(fall_back(wired, "scene = \n"));
    EXPECT_FALSE(fall_back(wired, "scene = \"nowhere\"\n[gpio]\nbutton = \"B\"\nstop = \"S\"\n"));
    write("exhibit.toml", plain);
    start();
    EXPECT_EQ(answer()["stop_unread"], false);
}

TEST_F(Exhibits, SayThatTheFactorysStandInUntilTheOwnersAreInForceWhole) {
    write("exhibit.toml", "[gpio]\nbutton = \"bridge:0\"\nstop = \"bridge:1\"\nmax_force_n = 3\n");
    start();
    EXPECT_EQ(answer()["source"], "factory");
    EXPECT_EQ(answer()["stands_in"], true);
    write("exhibit.toml", "max_force_n = 3\n[gpio]\nbutton = \"bridge:0\"\nstop = \"bridge:1\"\n");
    ASSERT_TRUE(take());
    EXPECT_EQ(answer()["source"], "new");
    EXPECT_EQ(answer()["stands_in"], true) << "the stop input waits for a start";
    crash();
    std::filesystem::remove_all(scratch_.path() / "state/config");
    start();
    EXPECT_EQ(answer()["stands_in"], false);
}

TEST_F(Exhibits, StandInForSettingsThatWentWithTheDisk) {
    write("exhibit.toml", "max_force_n = 3\n");
    start();
    pass(31s);
    crash();
    std::filesystem::remove(scratch_.path() / "eddy/exhibit.toml");
    scratch_.write("state/config/last-good", "torn");
    start();
    EXPECT_EQ(answer()["source"], "factory");
    EXPECT_EQ(answer()["stands_in"], true);
    EXPECT_EQ(answer()["result"], "refused");
}

TEST_F(Exhibits, StandInForSettingsThatThisVersionTakesNoMore) {
    scratch_.write("eddy/exhibit.toml", "max_farce_n = 3\n");
    ConfigSet old = read_config_set(scratch_.path() / "eddy", {});
    ConfigMemory(scratch_.path() / "state/config", "1", "0.9").keep_as_last_good(old);
    std::filesystem::remove(scratch_.path() / "eddy/exhibit.toml");
    start();
    EXPECT_EQ(answer()["source"], "factory");
    EXPECT_EQ(answer()["stands_in"], true);
    EXPECT_EQ(answer()["result"], "refused");
    EXPECT_EQ(answer()["unreadable_state"], 0);
}

TEST_F(Exhibits, StandInForNobodyWhenOnlyWhatCondemnsIsDamaged) {
    std::filesystem::create_directory(scratch_.path() / "state/config");
    for (const char* file : {"black-list", "probation"}) {
        scratch_.write(std::string("state/config/") + file, "torn");
        start();
        EXPECT_EQ(answer()["stands_in"], false) << file;
        EXPECT_EQ(answer()["result"], "applied") << file;
    }
    EXPECT_EQ(answer()["unreadable_state"], 2);
}

TEST_F(Exhibits, ReadNothingInSafeMode) {
    write("exhibit.toml", "max_force_n = 3\n");
    safe_mode_ = true;
    EXPECT_EQ(start().source, ConfigSource::Factory);
    EXPECT_EQ(answer()["result"], "not-read");
    write("exhibit.toml", "max_force_n = 2\n");
    EXPECT_FALSE(take());
    EXPECT_EQ(answer()["result"], "not-read") << "who brought it has to know";
}

/// Takes a file only when the test lets it.
class HeldDisk final : public Disk {
  public:
    std::atomic<bool> held = false;

    void write(const std::filesystem::path& file, std::string_view bytes) override {
        while (held) std::this_thread::sleep_for(1ms);
        real_disk().write(file, bytes);
    }
    void rename(const std::filesystem::path& from, const std::filesystem::path& to) override {
        real_disk().rename(from, to);
    }
    void remove(const std::filesystem::path& file) override { real_disk().remove(file); }
    void make_folder(const std::filesystem::path& folder) override { real_disk().make_folder(folder); }
    void flush_folder(const std::filesystem::path& folder) override { real_disk().flush_folder(folder); }
};

TEST_F(Exhibits, SayWhenADiskHoldsThemUp) {
    write("exhibit.toml", "max_force_n = 3\n");
    HeldDisk disk;
    intake_.emplace(
        ConfigIntake::Setup{.folder = scratch_.path() / "eddy", .state_dir = scratch_.path() / "state"},
        disk);
    intake_->accepted(intake_->start().hash, 0s);
    disk.held = true;
    intake_->poll(30s);
    ASSERT_TRUE(intake_->busy()) << "it is to be the last good one";
    EXPECT_FALSE(intake_->is_held_up(90s));
    EXPECT_TRUE(intake_->is_held_up(91s));
    EXPECT_FALSE(intake_->poll(91s)) << "and waits for nobody";
    disk.held = false;
    while (intake_->is_held_up(91s)) std::this_thread::sleep_for(1ms);
    intake_->poll(92s);
    EXPECT_FALSE(intake_->busy());
    EXPECT_FALSE(intake_->is_held_up(200s)) << "there is nothing to wait for";
}

}  // namespace
}  // namespace eddy
