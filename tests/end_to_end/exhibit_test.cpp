#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "firmware/haptic/force_gate.h"
#include "tests/end_to_end/program.h"
#include "tests/firmware/exhibit/manager_socket.h"

// The exhibit while it runs: settings dropped into its folder, a manager that listens, an end that was not asked for.

namespace eddy {
namespace {

using namespace std::chrono_literals;
using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// An exhibit on small grids, with folders of its own.
class ExhibitEndToEnd : public testing::Test {
  protected:
    ExhibitEndToEnd() {
        for (const char* name : {"etc", "run", "var"}) std::filesystem::create_directory(folder / name);
    }
    std::vector<std::string> command() const {
        return eddy_command({"run", "--display", "headless", "--haptics", "emulated", "--config",
                             folder / "etc", "--run-dir", folder / "run", "--state-dir", folder / "var",
                             "--set", kTiny, "--set", "render.width_px=160", "--set",
                             "render.height_px=120"});
    }
    /// Drivers that remember no shader take some seconds for a scene with all effects.
    std::vector<std::string> slow_command() const {
        std::vector<std::string> arguments = command();
        arguments.insert(arguments.begin(), {"env", "MESA_SHADER_CACHE_DISABLE=true"});
        return arguments;
    }
    /// Something is being built that was never tried before.
    bool builds() const {
        return in_time([this] { return std::filesystem::exists(folder / "var/config/probation"); });
    }
    /// As careful writers do it.
    void drop(const std::string& text) const {
        folder.write("etc/.new", text);
        std::filesystem::rename(folder / "etc/.new", folder / "etc/exhibit.toml");
    }
    nlohmann::json read(const std::string& name) const {
        return nlohmann::json::parse(read_all(folder / ("run/" + name)), nullptr, false);
    }
    nlohmann::json answer() const { return read("status/config.json"); }
    /// Until it is so; a slow machine may take its time.
    static bool in_time(const std::function<bool()>& so) {
        for (const auto end = std::chrono::steady_clock::now() + 3min; std::chrono::steady_clock::now() < end;
             std::this_thread::sleep_for(20ms))
            if (so()) return true;
        return false;
    }
    bool plays() const {
        return in_time([this] { return read("status.json").is_object(); });
    }
    long steps() const { return read("status.json").at("fluid").at("steps").get<long>(); }

    ScratchFolder folder;
};

TEST_F(ExhibitEndToEnd, TakesALiveSettingWithoutABreakInTheShow) {
    drop("max_force_n = 3\n");
    Program exhibit(command());
    ASSERT_TRUE(plays());
    ASSERT_EQ(answer().at("result"), "applied");
    const std::string before = answer().at("running_hash");
    drop("max_force_n = 2\n");
    EXPECT_TRUE(in_time([&] { return answer().at("running_hash") != before; })) << answer();
    EXPECT_EQ(answer().at("result"), "applied");
    EXPECT_TRUE(answer().at("errors").empty());
    exhibit.send(SIGTERM);
    const Ended ended = exhibit.wait();
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("settings were taken: max_force_n = 2"));
    EXPECT_THAT(ended.out, HasSubstr("In the jet")) << "the same act all along";
}

TEST_F(ExhibitEndToEnd, ShowsWordsUntilTheFluidIsReady) {
    Program exhibit(command());
    ASSERT_TRUE(plays());
    exhibit.send(SIGTERM);
    const Ended ended = exhibit.wait();
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("the first words are on"));
    std::vector<double> after_s;
    for (const std::string& line : lines_of(ended.err))
        if (const auto end = line.find(" s after the start"); end != line.npos)
            after_s.push_back(std::stod(line.substr(line.rfind(' ', end - 1))));
    ASSERT_EQ(after_s.size(), 2u) << ended.err;
    EXPECT_GT(after_s[0], 0.0);
    EXPECT_LT(after_s[0], after_s[1]);
}

TEST_F(ExhibitEndToEnd, PlaysTheOldSceneUntilTheNewOneIsReady) {
    drop("scene = \"jet\"\n");
    Program exhibit(command());
    ASSERT_TRUE(plays());
    EXPECT_EQ(read("status.json").at("scene"), "In the jet");
    drop("scene = \"stir\"\n");
    EXPECT_TRUE(in_time([&] { return read("status.json").at("scene") != "In the jet"; }));
    EXPECT_EQ(answer().at("result"), "applied");
    EXPECT_GT(steps(), 0);
    const auto force = [&] { return read("status.json").at("haptics").at("force"); };
    EXPECT_TRUE(in_time([&] {
        return force() == to_string(GateReason::Starting) || force() == to_string(GateReason::Open);
    })) << force();
    exhibit.send(SIGTERM);
    EXPECT_EQ(exhibit.wait().status, 0);
}

TEST_F(ExhibitEndToEnd, NoBadFileChangesTheShow) {
    drop("scene = \"jet\"\n");
    Program exhibit(command());
    ASSERT_TRUE(plays());
    const std::string running = answer().at("running_hash");
    std::string deep;
    for (int i = 0; i < 30'000; ++i) deep += "a.";
    for (const std::string& bad :
         {std::string("scene = \"nowhere\"\n"), std::string("scene = \"stir\nmax_force_n = 9\n"),
          std::string(), std::string("\x01\x02\n"), std::string("presets = [\"fast\"]\n"),
          deep + "a = 1\n"}) {
        const std::uint64_t refused = answer().at("refused");
        drop(bad);
        EXPECT_TRUE(in_time([&] { return answer().at("refused").get<std::uint64_t>() > refused; })) << bad;
        EXPECT_EQ(answer().at("result"), "refused") << bad;
        EXPECT_FALSE(answer().at("errors").empty()) << bad;
        EXPECT_EQ(answer().at("running_hash"), running) << bad;
    }
    const long before = steps();
    EXPECT_TRUE(in_time([&] { return steps() > before; })) << "the show went on";
    EXPECT_EQ(read("status.json").at("scene"), "In the jet");
    exhibit.send(SIGTERM);
    const Ended ended = exhibit.wait();
    EXPECT_EQ(ended.status, 0);
    EXPECT_THAT(ended.err, HasSubstr("exhibit.toml:1:9: scene")) << "each with its place";
}

TEST_F(ExhibitEndToEnd, StartsWithWhatWasGoodIfTheNewestKilledIt) {
    drop("scene = \"jet\"\n");
    {
        Program exhibit(command());
        ASSERT_TRUE(plays());
        exhibit.send(SIGKILL);  // within its probation
        exhibit.wait();
    }
    std::filesystem::remove(folder / "run/status.json");
    Program exhibit(command());
    ASSERT_TRUE(plays());
    EXPECT_EQ(answer().at("result"), "black-listed") << answer();
    EXPECT_EQ(answer().at("source"), "factory") << "there is nothing that was ever good";
    exhibit.send(SIGTERM);
    EXPECT_EQ(exhibit.wait().status, 0);
}

TEST_F(ExhibitEndToEnd, GivesNoForceWhileTheFactorysSettingsStandInForTheOwners) {
    drop("max_force_n = 99\n[gpio]\nbutton = \"bridge:0\"\nstop = \"bridge:1\"\n");
    Program exhibit(command());
    ASSERT_TRUE(plays());
    const auto force = [&] { return read("status.json").at("haptics").at("force").get<std::string>(); };
    EXPECT_TRUE(in_time([&] { return steps() > 10; }));
    EXPECT_EQ(force(), to_string(GateReason::Disabled));
    EXPECT_EQ(read("status.json").at("exhibit").at("state"), "degraded");
    EXPECT_EQ(answer().at("stands_in"), true) << answer();
    drop("max_force_n = 3\n");
    EXPECT_TRUE(in_time([&] { return force() != to_string(GateReason::Disabled); }));
    EXPECT_EQ(answer().at("stands_in"), false) << answer();
    exhibit.send(SIGTERM);
    const Ended ended = exhibit.wait();
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("exhibit.toml:1:15: max_force_n")) << "the cause";
    EXPECT_THAT(ended.err, HasSubstr("stand in for the owner's: no force"));
}

TEST_F(ExhibitEndToEnd, ReadsWhatIsDroppedWhileItPreparesItsFirstScene) {
    drop("scene = \"everything\"\n");
    Program exhibit(slow_command());
    ASSERT_TRUE(builds());
    drop("scene = \"nowhere\"\n");
    EXPECT_TRUE(in_time([&] { return answer().is_object(); }));
    EXPECT_EQ(answer().at("result"), "refused");
    EXPECT_EQ(answer().at("running_hash"), "") << "nothing played yet";
    drop("scene = \"stir\"\nmax_force_n = 2\n");
    ASSERT_TRUE(plays());
    EXPECT_EQ(read("status.json").at("scene"), "Stir the smoke");
    EXPECT_EQ(answer().at("result"), "applied");
    exhibit.send(SIGTERM);
    const Ended ended = exhibit.wait();
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("newer settings came while the fluid was being prepared"));
}

TEST_F(ExhibitEndToEnd, DoesNotBuildASceneAgainThatKilledItWhileItWasBuilt) {
    {
        Program exhibit(slow_command());
        ASSERT_TRUE(plays());
        drop("scene = \"everything\"\n");
        ASSERT_TRUE(builds());
        exhibit.send(SIGKILL);
        exhibit.wait();
    }
    EXPECT_EQ(answer().at("result"), "trying") << "not played yet";
    const std::string dropped = answer().at("hash");
    std::filesystem::remove(folder / "run/status.json");
    Program exhibit(command());
    ASSERT_TRUE(plays());
    EXPECT_EQ(answer().at("result"), "black-listed") << answer();
    EXPECT_EQ(answer().at("hash"), dropped);
    EXPECT_EQ(answer().at("source"), "factory");
    EXPECT_EQ(read("status.json").at("scene"), "In the jet");
    exhibit.send(SIGTERM);
    EXPECT_EQ(exhibit.wait().status, 0);
}

TEST_F(ExhibitEndToEnd, EndsWhenAskedWhileItBuildsASceneBesideTheShowAndBlamesNobody) {
    {
        Program exhibit(slow_command());
        ASSERT_TRUE(plays());
        drop("scene = \"everything\"\n");
        ASSERT_TRUE(builds());
        exhibit.send(SIGTERM);
        const Ended ended = exhibit.wait();
        EXPECT_EQ(ended.status, 0) << ended.err;
        EXPECT_THAT(ended.out, HasSubstr("In the jet")) << "what played is summed up";
        EXPECT_EQ(answer().at("result"), "trying") << "it ended in the middle of that";
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "var/config/probation"));
}

TEST_F(ExhibitEndToEnd, FeedsItsWatchdogWhileItBuildsASceneBesideTheShow) {
    ManagerSocket manager(folder / "notify");
    std::vector<std::string> arguments = slow_command();
    arguments.insert(arguments.begin() + 1,
                     {"NOTIFY_SOCKET=" + (folder / "notify"), "WATCHDOG_USEC=2000000"});
    Program exhibit(arguments);
    std::vector<std::string> heard;
    const auto hear = [&] {
        for (std::string& message : manager.messages()) heard.push_back(std::move(message));
    };
    const auto count = [&](const std::string& message) {
        hear();
        return std::count(heard.begin(), heard.end(), message);
    };
    EXPECT_TRUE(in_time([&] { return count("READY=1") > 0; })) << "no picture is wanted of it";
    ASSERT_TRUE(plays());
    drop("scene = \"everything\"\n");
    ASSERT_TRUE(builds());
    hear();
    heard.clear();
    EXPECT_TRUE(in_time([&] { return count("WATCHDOG_USEC=180000000") > 0; })) << "a shader may take long";
    EXPECT_TRUE(in_time([&] { return count("WATCHDOG=1") > 2; })) << "and in the pauses it lives";
    EXPECT_TRUE(in_time([&] {
        hear();
        return read("status.json").at("scene") != "In the jet";
    }));
    EXPECT_TRUE(in_time([&] { return count("WATCHDOG=1") > 10; }));
    const auto last = std::find_if(heard.rbegin(), heard.rend(),
                                   [](const std::string& m) { return m.starts_with("WATCHDOG_USEC="); });
    ASSERT_NE(last, heard.rend());
    EXPECT_EQ(*last, "WATCHDOG_USEC=2000000") << "as strict as before, when all is done";
    exhibit.send(SIGTERM);
    const Ended ended = exhibit.wait();
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_THAT(ended.err, Not(HasSubstr("does not get on")));
}

TEST_F(ExhibitEndToEnd, GivesAPictureToWhoAsksForOne) {
    Program exhibit(command());
    ASSERT_TRUE(plays());
    folder.write("run/screenshot.request", "");
    EXPECT_TRUE(in_time([&] { return std::filesystem::exists(folder / "run/screenshot.png"); }));
    EXPECT_TRUE(in_time([&] { return !std::filesystem::exists(folder / "run/screenshot.request"); }));
    EXPECT_THAT(read_all(folder / "run/screenshot.png"), HasSubstr("PNG"));
    exhibit.send(SIGTERM);
    EXPECT_EQ(exhibit.wait().status, 0);
}

TEST_F(ExhibitEndToEnd, SaysAndCountsWhatItCannotWrite) {
    std::filesystem::create_directory(folder / "run/eddy.prom.new");
    Program exhibit(command());
    ASSERT_TRUE(plays());
    EXPECT_TRUE(in_time([&] { return read("status.json").at("exhibit").at("disk_errors") > 0; }));
    exhibit.send(SIGTERM);
    const Ended ended = exhibit.wait();
    EXPECT_EQ(ended.status, 0) << "the show goes on";
    EXPECT_THAT(ended.err, HasSubstr("eddy.prom could not be written"));
}

TEST_F(ExhibitEndToEnd, EndsWellWithTheTerminalItWasStartedFrom) {
    Program exhibit(command());
    ASSERT_TRUE(plays());
    exhibit.send(SIGHUP);
    const Ended ended = exhibit.wait();
    EXPECT_EQ(ended.status, 0);
    EXPECT_THAT(ended.out, HasSubstr("haptic loop"));
}

TEST_F(ExhibitEndToEnd, AFirmwareImageThatCannotBeReadDoesNotEndAService) {
    drop("[falcon]\nfirmware = \"/gone/falcon.bin\"\n");
    ManagerSocket manager(folder / "notify");
    std::vector<std::string> arguments = command();
    std::replace(arguments.begin(), arguments.end(), std::string("emulated"), std::string("falcon"));
    EXPECT_EQ(Program(arguments).wait().status, 2) << "who asks at a terminal is told";
    arguments.insert(arguments.begin(), {"env", "NOTIFY_SOCKET=" + (folder / "notify")});
    Program exhibit(arguments);
    EXPECT_TRUE(plays());
    exhibit.send(SIGTERM);
    const Ended ended = exhibit.wait();
    EXPECT_EQ(ended.status, 0);
    EXPECT_THAT(ended.err, HasSubstr("/gone/falcon.bin"));
}

TEST_F(ExhibitEndToEnd, TellsItsManagerOfItsLife) {
    ManagerSocket manager(folder / "notify");
    std::vector<std::string> arguments = command();
    arguments.insert(arguments.begin(),
                     {"env", "NOTIFY_SOCKET=" + (folder / "notify"), "WATCHDOG_USEC=2000000"});
    Program exhibit(arguments);
    std::vector<std::string> heard;
    const auto has_heard = [&](const std::string& what) {
        return in_time([&] {
            for (std::string& message : manager.messages()) heard.push_back(std::move(message));
            return std::any_of(heard.begin(), heard.end(), [&](const std::string& message) {
                return message.find(what) != std::string::npos;
            });
        });
    };
    EXPECT_TRUE(has_heard("EXTEND_TIMEOUT_USEC=")) << "shaders take their time";
    EXPECT_TRUE(has_heard("READY=1"));
    EXPECT_TRUE(has_heard("WATCHDOG=1"));
    EXPECT_TRUE(has_heard("STATUS="));
    EXPECT_TRUE(plays());
    exhibit.send(SIGHUP);
    const long before = steps();
    EXPECT_TRUE(in_time([&] { return steps() > before + 10; }))
        << "a console that is hung up is no reason to end";
    exhibit.send(SIGTERM);
    EXPECT_EQ(exhibit.wait().status, 0);
    EXPECT_TRUE(has_heard("STOPPING=1"));

    std::filesystem::remove(folder / "run/status.json");
    heard.clear();
    Program next(arguments);
    EXPECT_TRUE(has_heard("READY=1"));
    EXPECT_TRUE(plays());
    next.send(SIGKILL);
    next.wait();
    std::filesystem::remove(folder / "run/status.json");
    heard.clear();
    Program third(arguments);
    EXPECT_TRUE(has_heard("READY=1"));
    EXPECT_TRUE(plays());
    third.send(SIGTERM);
    const Ended ended = third.wait();
    EXPECT_THAT(ended.err, HasSubstr("the run before this one ended by itself"));
    EXPECT_EQ(read("status.json").at("exhibit").at("total").at("starts"), 3) << read("status.json");
}

TEST_F(ExhibitEndToEnd, WaitsForTheFalconUnderAManager) {
    ManagerSocket manager(folder / "notify");
    std::vector<std::string> arguments = command();
    std::erase(arguments, "--haptics");
    std::erase(arguments, "emulated");
    arguments.insert(arguments.begin(), {"env", "NOTIFY_SOCKET=" + (folder / "notify")});
    Program exhibit(arguments);
    ASSERT_TRUE(plays());
    const auto haptics = [&] { return read("status.json").at("haptics"); };
    EXPECT_THAT(haptics().at("device").get<std::string>(), Not(HasSubstr("emulated"))) << haptics();
    EXPECT_THAT(haptics().at("device").get<std::string>(), HasSubstr("Falcon"));
    exhibit.send(SIGTERM);
    EXPECT_EQ(exhibit.wait().status, 0);
}

TEST_F(ExhibitEndToEnd, IsClosedOutsideItsHoursOnlyIfItsClockIsTrusted) {
    drop(
        "[hours]\nmonday = \"closed\"\ntuesday = \"closed\"\nwednesday = \"closed\"\nthursday = \"closed\"\n"
        "friday = \"closed\"\nsaturday = \"closed\"\nsunday = \"closed\"\n");
    Program exhibit(command());
    ASSERT_TRUE(plays());
    const auto state = [&] { return read("status.json").at("exhibit"); };
    const bool trusted = in_time([&] { return state().contains("clock_synchronised"); }) &&
                         state().at("clock_synchronised").get<bool>();
    if (trusted)
        EXPECT_TRUE(in_time([&] { return state().at("state") == "closed"; })) << state();
    else
        EXPECT_THAT(state().at("state"), AnyOf("attract", "in_use", "degraded")) << state();
    exhibit.send(SIGTERM);
    EXPECT_EQ(exhibit.wait().status, 0);
}

}  // namespace
}  // namespace eddy
