#include "firmware/exhibit/state_file.h"

#include <gtest/gtest.h>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

TEST(StateFile, GivesBackWhatWasWrittenLast) {
    const ScratchFolder folder;
    StateFile file(folder.path() / "deep/er/visits");
    EXPECT_EQ(file.read(), std::nullopt);
    EXPECT_EQ(file.unreadable(), 0) << "one that was never written is no trouble";
    for (const std::string text : {"12", "two\nlines\n", "", "sha256 of a sum\n"}) {
        file.write(text);
        EXPECT_EQ(file.read(), text);
        EXPECT_EQ(StateFile(file.path()).read(), text);
    }
    file.remove();
    file.remove();
    EXPECT_EQ(file.read(), std::nullopt);
    EXPECT_EQ(file.unreadable(), 0);
    EXPECT_TRUE(file.try_write("3"));
    EXPECT_EQ(file.read(), "3");
}

TEST(StateFile, ThatIsTornIsAsIfNotThereAndCounted) {
    const ScratchFolder folder;
    StateFile file(folder.path() / "visits");
    file.write("seventeen\n");
    const std::string whole = read_all(file.path());
    for (std::size_t length = 0; length < whole.size(); ++length) {
        folder.write("visits", whole.substr(0, length));
        EXPECT_EQ(file.read(), std::nullopt) << length;
    }
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string other = whole;
        other[at] = static_cast<char>(other[at] ^ 1);
        folder.write("visits", other);
        EXPECT_EQ(file.read(), std::nullopt) << at;
    }
    EXPECT_EQ(file.unreadable(), static_cast<int>(2 * whole.size()));
}

TEST(StateFile, ThatCannotBeWrittenSaysSoAndKeepsTheOldText) {
    const ScratchFolder folder;
    folder.write("taken", "");
    StateFile file(folder.path() / "taken/visits");
    EXPECT_THROW(file.write("1"), std::runtime_error);
    EXPECT_FALSE(file.try_write("1"));
    EXPECT_EQ(file.read(), std::nullopt);
}

}  // namespace
}  // namespace eddy
