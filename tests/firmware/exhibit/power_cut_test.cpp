#include <gtest/gtest.h>

#include <thread>

#include "config/sha256.h"
#include "firmware/exhibit/config_intake.h"
#include "firmware/exhibit/start_ledger.h"
#include "firmware/exhibit/usage.h"
#include "tests/firmware/exhibit/power_cut_disk.h"
#include "tests/scratch_folder.h"

// The power is cut after every operation of a day with three configurations, and what may be left on the disk is started from.

namespace eddy {
namespace {

using namespace std::chrono_literals;

constexpr const char* kHall = R"(title = "{}"
[tank]
cells = [16, 16, 16]
[[body]]
shape = "mesh"
file = "ball.obj"
centre_m = [0.08, 0.08, 0.08]
)";

/// A configuration that can be told from any piece of it: what it has at its end belongs to what it has at its beginning.
struct Version {
    double ceiling_n;
    std::string exhibit() const {
        return fmt::format("max_force_n = {}\nscene = \"hall.toml\"\n[falcon]\nserial = \"{}\"\n", ceiling_n,
                           ceiling_n);
    }
    std::string scene() const { return fmt::format(fmt::runtime(kHall), ceiling_n); }
    std::string mesh() const { return fmt::format("# {}\nv 0 0 0\n", ceiling_n); }
};

class Machine {
  public:
    Machine(const std::filesystem::path& root, Disk& disk, std::string boot)
        : root_(root),
          intake_({.folder = root / "eddy",
                   .state_dir = root / "state",
                   .run_dir = root / "run",
                   .boot = std::move(boot)},
                  disk) {}

    ConfigOffer start() {
        ConfigOffer offer = intake_.start();
        intake_.accepted(offer.hash, now_);
        return offer;
    }
    void pass(Instant time) {
        for (const Instant end = now_ + time; now_ < end;) {
            now_ += 250ms;
            do {
                if (auto offer = intake_.poll(now_)) intake_.accepted(offer->hash, now_);
                if (intake_.busy()) std::this_thread::sleep_for(1ms);
            } while (intake_.busy());
        }
    }
    const ConfigReport& report() const { return intake_.report(); }

  private:
    std::filesystem::path root_;
    ConfigIntake intake_;
    Instant now_{0s};
};

/// For what comes after a cut: it stays.
class QuickDisk final : public Disk {
  public:
    void write(const std::filesystem::path& file, std::string_view bytes) override {
        std::ofstream(file, std::ios::binary) << bytes;
    }
    void rename(const std::filesystem::path& from, const std::filesystem::path& to) override {
        std::filesystem::rename(from, to);
    }
    void remove(const std::filesystem::path& file) override { std::filesystem::remove(file); }
    void make_folder(const std::filesystem::path& folder) override {
        std::filesystem::create_directories(folder);
    }
    void flush_folder(const std::filesystem::path&) override {}
};

void lay_out(const std::map<std::string, std::string>& files, const ScratchFolder& folder) {
    for (const char* name : {"eddy", "eddy/conf.d", "state"})
        std::filesystem::create_directories(folder.path() / name);
    for (const auto& [name, bytes] : files) {
        std::filesystem::create_directories((folder.path() / name).parent_path());
        std::ofstream(folder.path() / name, std::ios::binary) << bytes;
    }
}

/// How the owner writes.
enum class Writer { Rsync, Scp };

struct Tally {
    int cuts = 0, started = 0, new_ones = 0, last_good = 0, factory = 0, cut_between_lines = 0;

    Tally& operator+=(const Tally& more) {
        cuts += more.cuts;
        started += more.started;
        new_ones += more.new_ones;
        last_good += more.last_good;
        factory += more.factory;
        cut_between_lines += more.cut_between_lines;
        return *this;
    }
};

void write(PowerCutDisk& disk, const std::filesystem::path& folder, const Version& v, Writer writer,
           bool sums) {
    const auto put = [&](const std::string& name, const std::string& text) {
        if (writer == Writer::Rsync)
            disk.replace_unflushed(folder / name, text);
        else
            disk.write_in_place(folder / name, text, 7);
    };
    // In any order; between two files the configuration is none of both, and refused or taken as it is.
    if (sums) put("exhibit.toml.sha256", sha256(v.exhibit()) + "  exhibit.toml\n");
    put("exhibit.toml", v.exhibit());
}

/// Three configurations, one after the other; returns after how many operations the first was kept.
std::size_t live_through(PowerCutDisk& disk, const std::filesystem::path& root, Writer writer, bool sums) {
    Machine machine(root, disk, "1");
    machine.start();
    machine.pass(31s);
    const std::size_t first_kept = disk.operations();
    EXPECT_EQ(machine.report().probation, false);
    for (const Version& next : {Version{2.0}, Version{3.0}}) {
        write(disk, root / "eddy", next, writer, sums);
        machine.pass(1s);
        EXPECT_EQ(machine.report().result, ConfigResult::Applied);
        machine.pass(31s);
        disk.flush_everything();
    }
    return first_kept;
}

void start_from(const std::map<std::string, std::string>& files, bool sums, bool may_be_factory,
                Tally& tally) {
    const ScratchFolder left;
    lay_out(files, left);
    QuickDisk quick;
    Machine machine(left.path(), quick, "2");
    ++tally.cuts;
    const ConfigOffer offer = machine.start();
    ++tally.started;
    EXPECT_EQ(machine.report().unreadable_state, 0);
    if (offer.source == ConfigSource::Factory) {
        ++tally.factory;
        EXPECT_TRUE(may_be_factory);
        return;
    }
    ++(offer.source == ConfigSource::New ? tally.new_ones : tally.last_good);
    const double n = offer.exhibit.max_force_n;
    if ((n == 1.0 || n == 2.0 || n == 3.0) && offer.exhibit.falcon.serial == fmt::format("{}", n))
        EXPECT_EQ(offer.scene.scene.title, "1");
    else if (sums)
        ADD_FAILURE() << "neither old nor new: " << files.at("eddy/exhibit.toml");
    else
        ++tally.cut_between_lines;
}

void survive_cuts(Writer writer, bool sums, int times, Tally& tally) {
    const Version first{1.0};
    const ScratchFolder day;
    lay_out({{"eddy/exhibit.toml", first.exhibit()},
             {"eddy/hall.toml", first.scene()},
             {"eddy/ball.obj", first.mesh()}},
            day);
    if (sums) day.write("eddy/exhibit.toml.sha256", sha256(first.exhibit()) + "\n");
    PowerCutDisk disk(day.path());
    const std::size_t first_kept = live_through(disk, day.path(), writer, sums);

    // Each start waits for the kernel to let go of the watches of the one before: several at once take less time.
    constexpr std::size_t kThreads = 16;
    std::vector<Tally> tallies(kThreads);
    std::vector<std::thread> threads;
    for (std::size_t thread = 0; thread < kThreads; ++thread)
        threads.emplace_back([&, thread] {
            for (std::size_t cut = thread; cut <= disk.operations(); cut += kThreads)
                for (int i = 0; i < times; ++i) {
                    SCOPED_TRACE(testing::Message() << "cut after operation " << cut << ", chance " << i);
                    std::mt19937_64 random(20261122 + 1000 * cut + static_cast<std::size_t>(i));
                    start_from(disk.after_cut(cut, random), sums, cut < first_kept, tallies[thread]);
                }
        });
    for (std::thread& thread : threads) thread.join();
    for (const Tally& part : tallies) tally += part;
}

TEST(PowerCut, LeavesTheOldOrTheNewConfigurationWheneverItComes) {
    Tally tally;
    survive_cuts(Writer::Rsync, true, 8, tally);
    survive_cuts(Writer::Scp, true, 8, tally);
    EXPECT_GE(tally.cuts, 1000);
    EXPECT_EQ(tally.started, tally.cuts);
    EXPECT_GT(tally.new_ones, 100);
    EXPECT_GT(tally.last_good, 20);
    RecordProperty("cuts", tally.cuts);
    std::printf("%d cuts: %d new, %d last good, %d factory\n", tally.cuts, tally.new_ones, tally.last_good,
                tally.factory);
}

TEST(PowerCut, LeavesStartsAndCountsWholeAndLosesNoStartThatWasPutDown) {
    const ScratchFolder day;
    PowerCutDisk disk(day.path());
    std::vector<std::size_t> put_down;  // after so many operations was each start
    for (int start = 0; start < 30; ++start) {
        UsageBook usage(day.path() / "state", disk);
        StartLedger ledger(day.path() / "state", disk);
        EXPECT_TRUE(ledger.begin(1000 * start, std::to_string(start)).written);
        put_down.push_back(disk.operations());
        usage.add(&Usage::starts, 1.0, 1000 * start);
        if (start % 2 == 0) ledger.end_well();
    }
    int cuts = 0;
    std::mt19937_64 random(20261124);
    for (std::size_t cut = 0; cut <= disk.operations(); ++cut)
        for (int i = 0; i < 4; ++i, ++cuts) {
            SCOPED_TRACE(testing::Message() << "cut after operation " << cut << ", chance " << i);
            const ScratchFolder left;
            lay_out(disk.after_cut(cut, random), left);
            StateFile starts(left.path() / "state/starts");
            const std::string text = starts.read().value_or("");
            EXPECT_EQ(starts.unreadable(), 0);
            const auto lines = std::count(text.begin(), text.end(), '\n');
            const auto known = std::upper_bound(put_down.begin(), put_down.end(), cut) - put_down.begin();
            EXPECT_TRUE(lines == known || lines == known + 1) << lines << " of " << known;
            EXPECT_FALSE(UsageBook(left.path() / "state").damaged());
        }
    EXPECT_GE(cuts, 1000);
    std::printf("%d cuts\n", cuts);
}

TEST(PowerCut, LeavesNothingUnreadableWithoutSumsEither) {
    Tally tally;
    survive_cuts(Writer::Rsync, false, 8, tally);
    survive_cuts(Writer::Scp, false, 8, tally);
    EXPECT_EQ(tally.started, tally.cuts);
    // What the documents say of files that were cut off between two lines: rare, and never nonsense.
    EXPECT_LT(tally.cut_between_lines, tally.cuts / 20);
    std::printf("%d cuts: %d new, %d last good, %d factory; %d cut between lines\n", tally.cuts,
                tally.new_ones, tally.last_good, tally.factory, tally.cut_between_lines);
}

}  // namespace
}  // namespace eddy
