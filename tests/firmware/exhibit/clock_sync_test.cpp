#include "firmware/exhibit/clock_sync.h"

#include <gtest/gtest.h>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

TEST(ClockSync, BelievesTheKernelOrTheFileAndIsNotSynchronisedWithoutEither) {
    const ScratchFolder folder;
    ClockSync sync(folder / "synchronized");
    EXPECT_FALSE(sync.look(KernelClock::Unsynchronised));
    EXPECT_FALSE(sync.look(KernelClock::NotTold));
    EXPECT_TRUE(ClockSync(folder / "synchronized").look(KernelClock::Synchronised));
    folder.write("synchronized", "");
    EXPECT_TRUE(sync.look(KernelClock::NotTold)) << "in a sandbox";
}

TEST(ClockSync, OnceRightIsRightEnoughForTheDay) {
    ClockSync sync("/nonexistent");
    EXPECT_TRUE(sync.look(KernelClock::Synchronised));
    EXPECT_TRUE(sync.look(KernelClock::Unsynchronised)) << "the network went away";
}

TEST(ClockSync, TheKernelCanBeAsked) {
    const KernelClock first = ask_kernel();
    EXPECT_LE(first, KernelClock::NotTold);
}

}  // namespace
}  // namespace eddy
