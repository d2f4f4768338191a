#include "firmware/exhibit/crash_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "firmware/built_from.h"
#include "firmware/haptic/flight_file.h"
#include "firmware/haptic/flight_rerun.h"
#include "tests/firmware/haptic/loop_rig.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

/// How a child ends that does this; it leaves no core.
int ended_by(const std::function<void()>& what) {
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit none{0, 0};
        ::setrlimit(RLIMIT_CORE, &none);
        for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::signal(signal, SIG_DFL);
        what();
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

/// An exhibit whose hand has moved for so many ticks, and that then ends badly.
int crash(const std::filesystem::path& folder, int signal, int ticks = 8300) {
    return ended_by([&] {
        LineRing lines;
        lines.add("run: begun");
        lines.add("run: a line before the end");
        LoopRig rig;
        CrashRecord record(folder, lines);
        record.watch(&rig.flights);
        rig.run(ticks);
        ::raise(signal);
    });
}

std::string one_that_ends(const ScratchFolder& folder, const std::string& with) {
    for (const std::string& name : folder.listing())
        if (name.ends_with(with)) return folder / name;
    return "";
}

TEST(CrashRecord, SaysWhatEndedTheProgramAndLetsItEndByThat) {
    for (const auto& [signal, name] :
         {std::pair(SIGSEGV, "SEGV"), {SIGABRT, "ABRT"}, {SIGBUS, "BUS"}, {SIGFPE, "FPE"}, {SIGILL, "ILL"}}) {
        const ScratchFolder folder;
        EXPECT_EQ(crash(folder.path(), signal, 10), signal);
        const auto said = CrashRecord::take_over(folder.path());
        ASSERT_THAT(said, SizeIs(1)) << name;
        EXPECT_THAT(said[0], AllOf(HasSubstr(name), HasSubstr("crash-"), HasSubstr("eddy replay")));
        const std::string text = read_all(one_that_ends(folder, ".txt"));
        EXPECT_THAT(text, AllOf(HasSubstr(std::string(" ") + name + "\nuptime_s 0\nbuild " + EDDY_VERSION),
                                HasSubstr(kBuiltFrom), EndsWith("run: begun\nrun: a line before the end\n")));
        EXPECT_THAT(CrashRecord::take_over(folder.path()), IsEmpty()) << "said once";
    }
}

TEST(CrashRecord, KeepsTheLastSecondsOfTheHandSoThatTheyRunAgainBitForBit) {
    const ScratchFolder folder;
    crash(folder.path(), SIGSEGV);
    CrashRecord::take_over(folder.path());
    const std::string file = one_that_ends(folder, ".flight");
    const Flight flight = read_flight(read_all(file), file);
    EXPECT_GE(flight.ticks.size(), FlightRecorder::kKeptTicks);
    EXPECT_EQ(flight.ticks.back().in.now, std::chrono::milliseconds(8300)) << "up to the last tick";
    EXPECT_EQ(flight.version, EDDY_VERSION);
    EXPECT_EQ(rerun(flight).differing, 0U);
}

TEST(CrashRecord, AStackThatIsUsedUpIsRecordedToo) {
    const ScratchFolder folder;
    const int signal = ended_by([&] {
        const rlimit small{256 * 1024, 256 * 1024};
        ::setrlimit(RLIMIT_STACK, &small);
        static LineRing lines;
        CrashRecord record(folder.path(), lines);
        struct Endless {
            static int fall(volatile char* above) {
                volatile char here[4096];
                here[0] = *above;
                if (*above == 7) return 0;  // never
                return fall(here) + here[0];
            }
        };
        volatile char top = 0;
        Endless::fall(&top);
    });
    EXPECT_EQ(signal, SIGSEGV);
    EXPECT_THAT(CrashRecord::take_over(folder.path()), SizeIs(1));
}

TEST(CrashRecord, KeepsTheLastThree) {
    const ScratchFolder folder;
    for (int i = 0; i < 5; ++i) {
        crash(folder.path(), SIGABRT, 10);
        CrashRecord::take_over(folder.path());
    }
    int texts = 0, flights = 0;
    for (const std::string& name : folder.listing()) {
        texts += name.ends_with(".txt");
        flights += name.ends_with(".flight");
    }
    EXPECT_EQ(texts, 3);
    EXPECT_EQ(flights, 3);
    EXPECT_THAT(folder.listing(), Not(Contains("crash.pending")));
}

TEST(CrashRecord, AGoodEndLeavesNothing) {
    const ScratchFolder folder;
    EXPECT_EQ(ended_by([&] {
                  LineRing lines;
                  CrashRecord record(folder.path(), lines);
              }),
              0);
    EXPECT_THAT(folder.listing(), IsEmpty());
    // Nor does a power cut: a file in which nothing is.
    folder.write("crash.pending", "");
    EXPECT_THAT(CrashRecord::take_over(folder.path()), IsEmpty());
    EXPECT_THAT(folder.listing(), IsEmpty());
}

TEST(CrashRecord, OneThatIsCutAnywhereStillSaysWhatItHas) {
    const ScratchFolder from;
    crash(from.path(), SIGSEGV, 1500);
    const std::string whole = read_all(from / "crash.pending");
    ASSERT_GT(whole.size(), 100'000U);
    for (std::size_t cut = 1; cut < whole.size(); cut += cut < 400 ? 1 : 40'009) {
        const ScratchFolder folder;
        folder.write("crash.pending", whole.substr(0, cut));
        ASSERT_THAT(CrashRecord::take_over(folder.path()), SizeIs(1)) << cut;
        EXPECT_EQ(one_that_ends(folder, ".flight"), "") << cut;
        EXPECT_NE(one_that_ends(folder, ".txt"), "") << cut;
    }
}

TEST(CrashRecord, OfAnotherBuildGivesNoFlight) {
    const ScratchFolder folder;
    crash(folder.path(), SIGSEGV, 1500);
    std::string bytes = read_all(folder / "crash.pending");
    bytes.replace(bytes.find("\nbuild ") + 7, 1, "X");
    folder.write("crash.pending", bytes);
    EXPECT_THAT(CrashRecord::take_over(folder.path()), Contains(Not(HasSubstr("eddy replay"))));
}

TEST(CrashRecord, WithoutAFolderTheProgramStillEndsByItsSignal) {
    EXPECT_EQ(crash("/nonexistent", SIGSEGV, 10), SIGSEGV);
    EXPECT_THAT(CrashRecord::take_over("/nonexistent"), IsEmpty());
}

}  // namespace
}  // namespace eddy
