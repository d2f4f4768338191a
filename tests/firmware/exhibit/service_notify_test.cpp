#include "firmware/exhibit/service_notify.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <time.h>

#include <cstdlib>

#include "tests/firmware/exhibit/manager_socket.h"

namespace eddy {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;
using namespace std::chrono_literals;

TEST(ServiceNotify, TellsTheManagerThroughAPath) {
    const ScratchFolder folder;
    ManagerSocket manager(folder / "notify");
    ServiceNotify notify(folder / "notify");
    ASSERT_TRUE(notify.listened_to());
    EXPECT_TRUE(notify.ready());
    EXPECT_TRUE(notify.status("stir, 24 steps/s\nsecond line"));
    EXPECT_TRUE(notify.watchdog());
    EXPECT_TRUE(notify.stopping());
    EXPECT_TRUE(notify.extend_start(180s));
    EXPECT_TRUE(notify.set_watchdog(2500ms));
    EXPECT_THAT(manager.messages(),
                ElementsAre("READY=1", "STATUS=stir, 24 steps/s second line", "WATCHDOG=1", "STOPPING=1",
                            "EXTEND_TIMEOUT_USEC=180000000", "WATCHDOG_USEC=2500000"));
}

TEST(ServiceNotify, TellsTheManagerThroughANameInNoFolder) {
    const std::string name = "@eddy-test-" + std::to_string(::getpid());
    ManagerSocket manager(name);
    ServiceNotify notify(name);
    EXPECT_TRUE(notify.ready());
    EXPECT_THAT(manager.messages(), ElementsAre("READY=1"));
}

TEST(ServiceNotify, SaysByTheMonotonicClockWhenItReloads) {
    const ScratchFolder folder;
    ManagerSocket manager(folder / "notify");
    ServiceNotify notify(folder / "notify");
    timespec before{}, after{};
    ::clock_gettime(CLOCK_MONOTONIC, &before);
    notify.reloading();
    ::clock_gettime(CLOCK_MONOTONIC, &after);
    const auto messages = manager.messages();
    ASSERT_EQ(messages.size(), 1U);
    ASSERT_THAT(messages[0], StartsWith("RELOADING=1\nMONOTONIC_USEC="));
    const long long usec = std::stoll(messages[0].substr(messages[0].rfind('=') + 1));
    EXPECT_GE(usec, before.tv_sec * 1'000'000LL + before.tv_nsec / 1000);
    EXPECT_LE(usec, after.tv_sec * 1'000'000LL + after.tv_nsec / 1000);
}

TEST(ServiceNotify, WithoutAManagerNothingHappens) {
    for (const char* socket : {"", "relative", "@", "/"}) {
        ServiceNotify notify{std::string_view(socket)};
        EXPECT_FALSE(notify.listened_to()) << socket;
        EXPECT_FALSE(notify.ready()) << socket;
    }
    EXPECT_FALSE(ServiceNotify(std::string(200, '/')).listened_to());
    EXPECT_FALSE(ServiceNotify("/nonexistent/notify").ready());
}

TEST(ServiceNotify, DoesNotWaitForAManagerThatDoesNotRead) {
    const ScratchFolder folder;
    ManagerSocket manager(folder / "notify");
    ServiceNotify notify(folder / "notify");
    int sent = 0;
    while (notify.watchdog() && sent < 100000) ++sent;
    EXPECT_LT(sent, 100000) << "the socket never filled up";
}

TEST(ServiceNotify, ChildrenDoNotGetTheSocket) {
    const ScratchFolder folder;
    ManagerSocket manager(folder / "notify");
    ::setenv("NOTIFY_SOCKET", (folder / "notify").c_str(), 1);
    ServiceNotify notify = ServiceNotify::from_environment();
    EXPECT_TRUE(notify.ready());
    EXPECT_EQ(std::getenv("NOTIFY_SOCKET"), nullptr);
    EXPECT_FALSE(ServiceNotify::from_environment().listened_to());
}

TEST(WatchdogPeriod, IsThatOfThisProcess) {
    EXPECT_EQ(watchdog_period("8000000", "17", 17), Seconds(8));
    EXPECT_EQ(watchdog_period("8000000", nullptr, 17), Seconds(8));
    EXPECT_EQ(watchdog_period("8000000", "18", 17), std::nullopt) << "meant for another";
    EXPECT_EQ(watchdog_period(nullptr, "17", 17), std::nullopt);
    for (const char* nonsense : {"", "0", "-1", "8s", "99999999999999999999"})
        EXPECT_EQ(watchdog_period(nonsense, nullptr, 17), std::nullopt) << nonsense;
}

}  // namespace
}  // namespace eddy
