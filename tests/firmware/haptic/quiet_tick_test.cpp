#include <dlfcn.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstddef>

#include "hal/haptic/emulated/make_emulated_falcon.h"
#include "hal/haptic/emulated/person_motion.h"
#include "loop_rig.h"
#include "tests/allocations.h"

// A tick of the loop asks nothing of the operating system and takes no lock. That it calls no GL is for the linker to see: the
// library of the loop knows none of it.

namespace {
std::atomic<std::uint64_t> g_locks{0};
}

// A sanitizer makes calls of its own, and has its own lock.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
// In place of the C library's; counts, and passes on.
extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) {
    using Lock = int (*)(pthread_mutex_t*);
    static const Lock real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
    g_locks.fetch_add(1, std::memory_order_relaxed);
    return real(mutex);
}
#endif

namespace eddy {
namespace {

/// From now on the kernel ends this process at any system call but exit_group. False where it will not.
bool forbid_system_calls() {
    constexpr auto number = static_cast<std::uint32_t>(offsetof(seccomp_data, nr));
    sock_filter filter[] = {
        {BPF_LD | BPF_W | BPF_ABS, 0, 0, number},
        {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, static_cast<std::uint32_t>(SYS_exit_group)},
        {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW},
        {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_KILL_PROCESS},
    };
    sock_fprog program{4, filter};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

/// Two seconds of stirring, the flight recorder included, then a fault.
void play(LoopRig& rig) {
    rig.run(2000);
    rig.device.is = HapticState::Fault;
    rig.run(600);
}

constexpr int kCannotForbid = 77;

void play_without_system_calls(bool with_one) {
    LoopRig rig;
    rig.run(10);
    if (!forbid_system_calls()) _exit(kCannotForbid);
    play(rig);
    if (with_one) getppid();
    _exit(0);
}

bool can_forbid() {
    const auto cannot = [] {
        if (!forbid_system_calls()) _exit(kCannotForbid);
        _exit(0);
    };
    int status = 0;
    const pid_t child = fork();
    if (child == 0) cannot();
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(QuietTick, MakesNoSystemCall) {
    if (kSanitized) GTEST_SKIP() << "skipped: a sanitizer makes system calls of its own";
    if (!can_forbid()) GTEST_SKIP() << "this kernel lets nobody forbid system calls";
    EXPECT_EXIT(play_without_system_calls(false), testing::ExitedWithCode(0), "");
    EXPECT_EXIT(play_without_system_calls(true), testing::KilledBySignal(SIGSYS), "")
        << "or the test would see nothing";
}

TEST(QuietTick, TakesNoLock) {
    if (kSanitized) GTEST_SKIP() << "skipped: a sanitizer has its own lock";
    LoopRig rig;
    rig.run(10);
    pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    std::uint64_t before = g_locks;
    pthread_mutex_lock(&mutex);
    pthread_mutex_unlock(&mutex);
    EXPECT_EQ(g_locks, before + 1) << "or the test would see nothing";
    before = g_locks;
    play(rig);
    EXPECT_EQ(g_locks, before);
}

TEST(QuietTick, OfTheFalconsDriverNeitherLocksNorAllocates) {
    emulated::PersonSettings person;
    const auto device = emulated::make_emulated_falcon(std::make_unique<emulated::PersonMotion>(person));
    HapticExchange exchange;
    TickTrace trace(10);
    HapticLoop loop(*device, exchange, trace);
    int ms = 0;
    const auto run = [&](int ticks) {
        for (int i = 0; i < ticks; ++i) loop.tick(std::chrono::milliseconds(++ms));
    };
    run(100);
    const std::uint64_t locks = g_locks, memory = allocations();
    run(2000);
    EXPECT_EQ(g_locks, locks);
    EXPECT_EQ(allocations(), memory);
    EXPECT_EQ(exchange.report.newest().device, HapticState::Ready);
}

}  // namespace
}  // namespace eddy
