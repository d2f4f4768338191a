#include "firmware/exhibit/usage.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <thread>

#include "tests/firmware/exhibit/time_zone.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

/// Files are kept as they are, but only when the test says so.
class SlowDisk final : public Disk {
  public:
    std::atomic<int> begun = 0, let_through = 0, done = 0;

    void write(const std::filesystem::path& file, std::string_view bytes) override {
        for (const int mine = begun++; let_through <= mine;) std::this_thread::yield();
        real_disk().write(file, bytes);
    }
    void rename(const std::filesystem::path& from, const std::filesystem::path& to) override {
        real_disk().rename(from, to);
        ++done;
    }
    void remove(const std::filesystem::path& file) override { real_disk().remove(file); }
    void make_folder(const std::filesystem::path& folder) override { real_disk().make_folder(folder); }
    void flush_folder(const std::filesystem::path&) override {}
};

/// As long as it lives no thread can be begun: each would want 64 TiB for its stack.
class NoThreads {
  public:
    NoThreads() {
        pthread_getattr_default_np(&before_);
        pthread_attr_t attributes = before_;
        pthread_attr_setstacksize(&attributes, std::size_t{1} << 46);
        pthread_setattr_default_np(&attributes);
    }
    ~NoThreads() { pthread_setattr_default_np(&before_); }
    NoThreads(const NoThreads&) = delete;
    NoThreads& operator=(const NoThreads&) = delete;

  private:
    pthread_attr_t before_;
};

/// Waits for it, for half a minute.
template <class Condition>
bool comes(Condition condition) {
    const auto end = std::chrono::steady_clock::now() + 30s;
    while (std::chrono::steady_clock::now() < end) {
        if (condition()) return true;
        std::this_thread::yield();
    }
    return false;
}

class UsageTest : public testing::Test {
  protected:
    const TimeZone zone_{kBerlin};
    const ScratchFolder folder_;
    const std::time_t noon_ = utc("2026-11-24 11:00:00Z"), tomorrow_ = noon_ + 86400;
};

TEST_F(UsageTest, CountsByTheDayAndForGood) {
    {
        UsageBook book(folder_.path());
        book.add(&Usage::visits, 2, noon_);
        book.add(&Usage::force_s, 12.5, noon_);
        book.add(&Usage::visits, 1, tomorrow_);
    }
    UsageBook book(folder_.path());
    book.add(&Usage::visits, 1, tomorrow_);
    EXPECT_EQ(book.total().visits, 4.0);
    EXPECT_EQ(book.total().force_s, 12.5);
    EXPECT_EQ(book.on(noon_).visits, 2.0);
    EXPECT_EQ(book.on(tomorrow_).visits, 2.0);
    EXPECT_EQ(book.on(tomorrow_ + 86400), Usage{});
    EXPECT_FALSE(book.damaged());
}

TEST_F(UsageTest, ADayEndsAtMidnightByTheWall) {
    UsageBook book(folder_.path());
    book.add(&Usage::visits, 1, utc("2026-11-24 22:59:59Z"));
    book.add(&Usage::visits, 1, utc("2026-11-24 23:00:00Z"));
    book.write();
    const std::string text = read_all(folder_ / "usage");
    for (const char* day : {"2026-11-24 visits 1 ", "2026-11-25 visits 1 "})
        EXPECT_NE(text.find(day), text.npos) << text;
}

TEST_F(UsageTest, WithoutAThreadToWriteOnTheShowWaitsForIt) {
    UsageBook book(folder_.path());
    book.add(&Usage::visits, 1, noon_);
    {
        const NoThreads none;
        EXPECT_THROW(std::thread([] {}).join(), std::system_error);
        EXPECT_TRUE(book.go_on(0s));
    }
    EXPECT_TRUE(book.go_on(1s));
    EXPECT_NE(read_all(folder_ / "usage").find("visits 1 "), std::string::npos);
}

TEST_F(UsageTest, IsWrittenOnceAMinuteAtMost) {
    SlowDisk disk;
    disk.let_through = 1000;
    UsageBook book(folder_.path(), disk);
    for (int second = 0; second < 600; ++second) {
        book.add(&Usage::force_s, 1, noon_);
        const Instant now = std::chrono::seconds(second);
        ASSERT_TRUE(comes([&] { return book.go_on(now) && disk.done == second / 60 + 1; })) << second;
    }
    EXPECT_EQ(disk.begun, 10);
}

TEST_F(UsageTest, ASlowDiskIsWaitedForAtTheEndOnly) {
    SlowDisk disk;
    {
        UsageBook book(folder_.path(), disk);
        for (Instant t = 0s; t < 300s; t += 1s) {
            book.add(&Usage::force_s, 1, noon_);
            EXPECT_TRUE(book.go_on(t));
        }
        ASSERT_TRUE(comes([&] { return disk.begun == 1; }));
        EXPECT_TRUE(folder_.listing().empty());
        disk.let_through = 2;
    }
    EXPECT_EQ(disk.begun, 2)
        << "what came after the first was never written, or one began before another had ended";
    EXPECT_EQ(UsageBook(folder_.path()).total().force_s, 300.0);
}

TEST_F(UsageTest, NothingNewIsNotWritten) {
    UsageBook book(folder_.path());
    book.go_on(100s);
    book.write();
    EXPECT_TRUE(folder_.listing().empty());
}

TEST_F(UsageTest, APowerCutWhileItWritesLeavesWhatWasThere) {
    std::string newer;
    {
        UsageBook book(folder_.path());
        book.add(&Usage::visits, 7, noon_);
    }
    const std::string older = read_all(folder_ / "usage");
    {
        UsageBook book(folder_.path());
        book.add(&Usage::visits, 1, noon_);
    }
    newer = read_all(folder_ / "usage");
    // What replace_text_file has done when the power goes: a part of the new text beside the old.
    for (std::size_t cut = 0; cut <= newer.size(); ++cut) {
        folder_.write("usage", older);
        folder_.write("usage.new", newer.substr(0, cut));
        UsageBook book(folder_.path());
        ASSERT_EQ(book.total().visits, 7.0) << cut;
        ASSERT_FALSE(book.damaged());
    }
}

TEST_F(UsageTest, AFileCutAnywhereIsNoticedAndPutAside) {
    {
        UsageBook book(folder_.path());
        book.add(&Usage::visits, 7, noon_);
        book.add(&Usage::starts, 123456789, noon_);
    }
    const std::string whole = read_all(folder_ / "usage");
    for (std::size_t cut = 0; cut < whole.size(); ++cut) {
        folder_.write("usage", whole.substr(0, cut));
        UsageBook book(folder_.path());
        ASSERT_TRUE(book.damaged()) << cut;
        ASSERT_EQ(book.total(), Usage{});
        ASSERT_EQ(read_all(folder_ / "usage.damaged"), whole.substr(0, cut));
    }
}

TEST_F(UsageTest, NonsenseIsNotCounted) {
    for (const char* text : {"", "x", "eddy usage 1\ntotal visits -1\n", "eddy usage 1\ntotal visits nan\n",
                             "eddy usage 1\n", "eddy usage 1\ntotal visits\n"}) {
        StateFile(folder_ / "usage").write(text);
        EXPECT_TRUE(UsageBook(folder_.path()).damaged()) << text;
    }
    StateFile(folder_ / "usage").write("eddy usage 1\ntotal visits 3 of_a_newer_program 7\n");
    EXPECT_EQ(UsageBook(folder_.path()).total().visits, 3.0);
}

TEST_F(UsageTest, KeepsASeasonOfDaysAndAllOfTheTotal) {
    UsageBook book(folder_.path());
    for (int day = 0; day < 400; ++day) book.add(&Usage::visits, 1, noon_ + day * 86400);
    EXPECT_EQ(book.total().visits, 400.0);
    const auto oldest = static_cast<std::time_t>(400 - UsageBook::kMostDays);
    EXPECT_EQ(book.on(noon_ + (oldest - 1) * 86400), Usage{});
    EXPECT_EQ(book.on(noon_ + oldest * 86400).visits, 1.0);
    EXPECT_EQ(book.on(noon_ + 399 * 86400).visits, 1.0);
    book.write();
    EXPECT_LT(std::filesystem::file_size(folder_ / "usage"), 16000U);
}

TEST_F(UsageTest, AFullDiskIsSaidAndTriedAgain) {
    folder_.write("no_folder", "");
    UsageBook book(folder_ / "no_folder");
    book.add(&Usage::visits, 1, noon_);
    EXPECT_TRUE(comes([&] { return !book.go_on(0s); }));
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(book.go_on(59s)) << "not due yet";
    EXPECT_TRUE(comes([&] { return !book.go_on(61s); }));
    EXPECT_FALSE(book.write());
}

}  // namespace
}  // namespace eddy
