#include "firmware/haptic/realtime.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <cerrno>
#include <thread>

namespace eddy {
namespace {

TEST(Realtime, ReportsWhatTheSystemReallyGranted) {
    std::thread([] {  // a thread of its own: the grant stays with it
        const RealtimeGrant grant = grant_realtime(MemoryLock::No);
        sched_param parameters{};
        int policy = SCHED_OTHER;
        ASSERT_EQ(pthread_getschedparam(pthread_self(), &policy, &parameters), 0);
        EXPECT_EQ(grant.fifo, policy == SCHED_FIFO);
        EXPECT_EQ(parameters.sched_priority, grant.fifo ? kHapticPriority : 0);
        EXPECT_EQ(grant.fifo_error, grant.fifo ? 0 : EPERM);
        EXPECT_FALSE(grant.memory_locked);
        EXPECT_EQ(grant.memory_error, 0);
    })
        .join();
}

}  // namespace
}  // namespace eddy
