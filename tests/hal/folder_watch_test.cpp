#include "hal/folder_watch.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

void append(const std::string& file, const std::string& text) {
    std::ofstream(file, std::ios::binary | std::ios::app) << text;
}

/// A watch over a folder that holds x; time passes only when a test says so.
class AFolder : public testing::Test {
  protected:
    AFolder() {
        fs::create_directory(folder_);
        append(file_, "old\n");
        watch_.watch({folder_});
        watch_.poll(now_);
    }
    bool changed() { return watch_.poll(now_).changed; }
    bool writing() { return watch_.poll(now_).writing; }

    const ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path() / "eddy";
    const std::string file_ = folder_ / "x.toml";
    FolderWatch watch_;
    Instant now_{0s};
};

TEST_F(AFolder, IsQuietWhileNobodyWrites) {
    for (; now_ < 20s; now_ += 100ms) EXPECT_FALSE(changed());
    EXPECT_EQ(watch_.counters().seen_late, 0u);
}

TEST_F(AFolder, TellsOfAFileWrittenInPlaceInTwoPiecesOnlyWhenItIsClosed) {  // scp, cp, >
    const int out = ::open(file_.c_str(), O_WRONLY | O_TRUNC);
    ASSERT_EQ(::write(out, "ne", 2), 2);
    FolderWatch::News news = watch_.poll(now_);
    EXPECT_FALSE(news.changed);
    EXPECT_TRUE(news.writing);
    now_ += 20s;  // a slow line; a look finds it changed, but it is still being written
    ASSERT_EQ(::write(out, "w\n", 2), 2);
    EXPECT_FALSE(changed());
    ::close(out);
    news = watch_.poll(now_);
    EXPECT_TRUE(news.changed);
    EXPECT_FALSE(news.writing);
    EXPECT_FALSE(changed());
}

TEST_F(AFolder, DoesNotWaitForEverForAWriterThatSaysNothing) {
    const int out = ::open(file_.c_str(), O_WRONLY | O_TRUNC);
    ASSERT_EQ(::write(out, "ne", 2), 2);
    EXPECT_TRUE(writing());
    now_ += FolderWatch::kWriterPatience + 1s;
    EXPECT_TRUE(changed());
    EXPECT_FALSE(writing());
    ::close(out);
}

TEST_F(AFolder, TellsOfAFileRenamedOverTheOldOneAgainAndAgain) {  // rsync, ansible, syncthing
    for (int i = 0; i < 3; ++i) {
        append(folder_ / ".x.toml.Ab12Cd", "new\n");
        EXPECT_FALSE(changed()) << "what is written beside it is no news";
        fs::rename(folder_ / ".x.toml.Ab12Cd", file_);
        EXPECT_TRUE(changed());
        EXPECT_FALSE(changed());
    }
}

TEST_F(AFolder, TellsOfAFileMovedInAndOut) {  // mv
    append(scratch_ / "y.toml", "new\n");
    fs::rename(scratch_ / "y.toml", folder_ / "y.toml");
    EXPECT_TRUE(changed());
    fs::rename(folder_ / "y.toml", scratch_ / "y.toml");
    EXPECT_TRUE(changed());
}

TEST_F(AFolder, TellsOfAFileDeletedAndMadeAnew) {  // git checkout
    fs::remove(file_);
    EXPECT_TRUE(changed());
    const int out = ::open(file_.c_str(), O_WRONLY | O_CREAT, 0644);
    EXPECT_FALSE(changed()) << "a file that was only created is empty yet";
    ASSERT_EQ(::write(out, "new\n", 4), 4);
    ::close(out);
    EXPECT_TRUE(changed());
}

TEST_F(AFolder, TellsOfATouch) {
    const int out = ::open(file_.c_str(), O_WRONLY);
    ::close(out);
    EXPECT_TRUE(changed());
}

TEST_F(AFolder, TellsOfALinkInItThatIsTurned) {  // ..data of a mounted ConfigMap
    for (const char* version : {"..1", "..2"}) {
        fs::create_directory(folder_ / version);
        append(folder_ / version / "x.toml", version);
    }
    fs::create_directory_symlink("..1", folder_ / "..data");
    changed();
    fs::create_directory_symlink("..2", folder_ / "..new");
    EXPECT_FALSE(changed());
    fs::rename(folder_ / "..new", folder_ / "..data");
    EXPECT_TRUE(changed());
}

TEST_F(AFolder, ThatIsALinkIsFollowedWhenItIsTurned) {  // a work tree for each release
    for (const char* release : {"release-1", "release-2"}) fs::create_directory(scratch_.path() / release);
    const fs::path current = scratch_.path() / "current";
    fs::create_directory_symlink("release-1", current);
    watch_.watch({current, current / "conf.d"});
    changed();
    append(scratch_.path() / "release-1/x.toml", "a\n");
    EXPECT_TRUE(changed());
    fs::create_directory_symlink("release-2", scratch_.path() / "next");
    EXPECT_FALSE(changed());
    fs::rename(scratch_.path() / "next", current);
    EXPECT_TRUE(changed());
    append(scratch_.path() / "release-2/x.toml", "b\n");
    EXPECT_TRUE(changed());
    append(scratch_.path() / "release-1/x.toml", "c\n");
    EXPECT_FALSE(changed()) << "nobody reads that one any more";
    fs::create_directory(scratch_.path() / "release-2/conf.d");
    EXPECT_TRUE(changed());
    append(scratch_.path() / "release-2/conf.d/10.toml", "c\n");
    EXPECT_TRUE(changed());
}

TEST_F(AFolder, MayComeLaterAndGoAndComeBack) {
    const fs::path later = scratch_.path() / "mnt/stick/eddy";
    watch_.watch({later});
    EXPECT_FALSE(changed());
    for (int i = 0; i < 2; ++i) {
        fs::create_directories(later);
        EXPECT_TRUE(changed());
        append(later / "x.toml", "a\n");
        EXPECT_TRUE(changed());
        EXPECT_FALSE(changed());
        fs::remove_all(scratch_.path() / "mnt");
        EXPECT_TRUE(changed());
        EXPECT_FALSE(changed());
    }
    EXPECT_EQ(watch_.counters().lost, 2u);
}

TEST_F(AFolder, IsLookedAtEveryFiveSeconds) {
    // What lies behind a link is written to where nobody watches: the kernel tells nothing, as on a network file system.
    append(scratch_ / "far.toml", "a\n");
    fs::create_symlink(scratch_ / "far.toml", folder_ / "y.toml");
    now_ += FolderWatch::kLookEvery;
    changed();
    append(scratch_ / "far.toml", "b\n");
    now_ += FolderWatch::kLookEvery - 1ms;
    EXPECT_FALSE(changed());
    now_ += 1ms;
    EXPECT_TRUE(changed());
    EXPECT_EQ(watch_.counters().seen_late, 2u);
    now_ += FolderWatch::kLookEvery;
    EXPECT_FALSE(changed());
}

TEST_F(AFolder, IsReadAnewWhenMoreHappenedThanTheKernelKept) {
    std::size_t most = 16384;
    std::ifstream("/proc/sys/fs/inotify/max_queued_events") >> most;
    if (most > 200'000) GTEST_SKIP() << "skipped: this kernel keeps " << most << " events";
    for (std::size_t i = 0; i < most / 2 + 10;
         ++i) {  // each opening tells once; neighbours that are the same count once
        ::close(::open(file_.c_str(), O_WRONLY));
        ::close(::open((folder_ / "y.toml").c_str(), O_WRONLY | O_CREAT, 0644));
    }
    EXPECT_TRUE(changed());
    EXPECT_EQ(watch_.counters().overflows, 1u);
    append(file_, "new\n");
    EXPECT_TRUE(changed());
}

TEST_F(AFolder, IsNotDisturbedByNamesThatWritersUseInBetween) {
    for (const char* name : {".x.toml.swp", "x.toml~", "x.tmp", "x.part", ".#x.toml"}) {
        EXPECT_TRUE(FolderWatch::is_temporary(name)) << name;
        append(folder_ / name, "?");
        EXPECT_FALSE(changed()) << name;
        now_ += FolderWatch::kLookEvery;
        EXPECT_FALSE(changed()) << name;
    }
    EXPECT_FALSE(FolderWatch::is_temporary("..data"));
    EXPECT_FALSE(FolderWatch::is_temporary("10-site.toml"));
}

TEST_F(AFolder, ThatIsUnmountedIsWatchedAgainBelow) {
    // Mounts of this process alone; needs rights that not every builder gives.
    const pid_t child = ::fork();
    if (child == 0) {
        if (::unshare(CLONE_NEWNS) != 0 ||
            ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
            ::mount("none", folder_.c_str(), "tmpfs", 0, nullptr) != 0)
            ::_exit(77);
        FolderWatch watch;
        watch.watch({folder_});
        append(file_, "on the stick\n");
        bool good = watch.poll(now_).changed;
        good = ::umount(folder_.c_str()) == 0 && good;
        good = watch.poll(now_).changed && good;
        append(file_, "below\n");
        good = watch.poll(now_).changed && good;
        ::_exit(good && watch.counters().lost == 1 ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 77)
        GTEST_SKIP() << "skipped: nothing can be mounted here";
    EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace eddy
