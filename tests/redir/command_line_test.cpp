#include "tests/redir/command_line.h"

#include <gtest/gtest.h>

namespace eddy::redir {
namespace {

using namespace std::chrono_literals;

TEST(RedirCommands, AreWordsBetweenSpaces) {
    EXPECT_EQ(words_of("  press 3\t200ms "), (std::vector<std::string>{"press", "3", "200ms"}));
    EXPECT_TRUE(words_of(" \t").empty());
}

TEST(RedirCommands, ATimeHasAUnitOrIsInMilliseconds) {
    EXPECT_EQ(time_in("2s"), Instant(2s));
    EXPECT_EQ(time_in("0.5s"), Instant(500ms));
    EXPECT_EQ(time_in("300ms"), Instant(300ms));
    EXPECT_EQ(time_in("300"), Instant(300ms));
    for (const char* wrong : {"", "s", "ms", "-1s", "1m", "1 s", "nan", "2000000000"})
        EXPECT_FALSE(time_in(wrong)) << wrong;
}

TEST(RedirCommands, ALineIsAWholeNumberWithinItsRange) {
    EXPECT_EQ(index_in("7", 7), 7U);
    for (const char* wrong : {"8", "-1", "1.5", "", "x", "1x"}) EXPECT_FALSE(index_in(wrong, 7)) << wrong;
}

}  // namespace
}  // namespace eddy::redir
