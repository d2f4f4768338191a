#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

using testing::HasSubstr;

// How even the ticks are is the machine's affair, and no test's.
TEST(RtSelftest, SaysWhatItMeasuredAndWhatTheSystemGranted) {
    const Ended ended = eddy({"rt-selftest", "--haptics", "emulated", "--seconds", "1"});
    EXPECT_TRUE(ended.status == 0 || ended.status == 1) << ended.err;
    EXPECT_EQ(ended.err, "");
    for (const char* line : {"device      Novint Falcon, emulated: ready\n", "\npriority    ",
                             "\nmemory      ", "\nperiod      mean ", "\nexchange    ", "\nverdict     "})
        EXPECT_THAT(ended.out, HasSubstr(line));
    EXPECT_EQ(ended.status == 0, ended.out.find("verdict     good") != std::string::npos) << ended.out;
}

}  // namespace
}  // namespace eddy
