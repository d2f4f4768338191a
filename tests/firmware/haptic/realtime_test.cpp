#include "firmware/haptic/realtime.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <cerrno>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace eddy {
namespace {

/// Of this process, as the kernel counts it.
long locked_kb() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (long kb = 0; word == "VmLck:" && status >> kb) return kb;
    return -1;
}

TEST(Realtime, SaysInOneLineWhatWasGrantedAndWhatToDoAboutTheRest) {
    EXPECT_EQ(
        sentence_of({.fifo = true, .locked_bytes = 12'300'000}),
        "the haptic thread runs at real-time priority (SCHED_FIFO 50); its 12.3 MB of memory are locked");
    EXPECT_EQ(
        sentence_of({.fifo_error = EPERM, .memory_error = ENOMEM}),
        "the haptic thread has no real-time priority (Operation not permitted): ticks come late when the "
        "machine "
        "is busy; a service gets it by LimitRTPRIO=50 in its unit; not all of its memory is locked (Cannot "
        "allocate memory): a service gets that by LimitMEMLOCK=64M");
}

TEST(Realtime, ReportsWhatTheSystemReallyGranted) {
    std::thread([] {  // a thread of its own: the grant stays with it
        const std::vector<std::byte> touched(1 << 20);
        [[maybe_unused]] const long before_kb = locked_kb();
        const RealtimeGrant grant = grant_realtime({std::span(touched)});
        sched_param parameters{};
        int policy = SCHED_OTHER;
        ASSERT_EQ(pthread_getschedparam(pthread_self(), &policy, &parameters), 0);
        EXPECT_EQ(grant.fifo, policy == SCHED_FIFO);
        EXPECT_EQ(parameters.sched_priority, grant.fifo ? kHapticPriority : 0);
        EXPECT_EQ(grant.fifo_error, grant.fifo ? 0 : EPERM);
        if (grant.memory_error == 0) {
            EXPECT_GT(grant.locked_bytes, touched.size()) << "and the stack";
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their own mlock() locks nothing
            EXPECT_GE(locked_kb() - before_kb, 1024);
#endif
        }
    })
        .join();
}

}  // namespace
}  // namespace eddy
