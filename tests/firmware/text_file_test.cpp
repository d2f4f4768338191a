#include "firmware/text_file.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

template <class F>
std::string refusal(F f) {
    try {
        f();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

bool holds(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

TEST(TextFile, IsReadBackByteForByte) {
    const ScratchFolder folder;
    const std::string text("one\r\ntwo\0three\n", 15);
    replace_text_file(folder / "a", text);
    EXPECT_EQ(read_text_file(folder / "a"), text);
    replace_text_file(folder / "a", "");
    EXPECT_EQ(read_text_file(folder / "a"), "");
    EXPECT_EQ(folder.listing(), std::vector<std::string>{"a"});
}

TEST(TextFile, IsSeenOldOrNewButNeverInBetween) {
    const ScratchFolder folder;
    const std::string file = folder / "status.json";
    constexpr std::size_t kBytes = 300'000;
    replace_text_file(file, std::string(kBytes, 'a'));
    std::atomic<bool> done{false};
    std::thread writer([&] {
        for (int i = 0; i < 100; ++i) replace_text_file(file, std::string(kBytes, i % 2 ? 'a' : 'b'));
        done = true;
    });
    int reads = 0, whole = 0;
    while (!done || reads == 0) {
        const std::string text = read_text_file(file);
        ++reads;
        whole += text == std::string(kBytes, 'a') || text == std::string(kBytes, 'b');
    }
    writer.join();
    EXPECT_EQ(whole, reads);
}

TEST(TextFile, ThatCannotBeReplacedKeepsItsTextAndLeavesNothingBeside) {
    const ScratchFolder folder;
    std::filesystem::create_directories(folder / "taken/inside");
    const auto before = folder.listing();
    const std::string said = refusal([&] { replace_text_file(folder / "taken", "text"); });
    EXPECT_TRUE(holds(said, folder / "taken") && holds(said, "directory")) << said;
    EXPECT_EQ(folder.listing(), before);
}

TEST(TextFile, InAMissingFolderIsNamed) {
    const ScratchFolder folder;
    const std::string said = refusal([&] { replace_text_file(folder / "no/such/file", "text"); });
    EXPECT_TRUE(holds(said, folder / "no/such/file") && holds(said, "No such file")) << said;
}

TEST(TextFile, OnAFullDiskIsNamed) {
    // A device that takes no byte, under the name beside the file.
    const ScratchFolder folder;
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "skipped: this system has no /dev/full";
    std::filesystem::create_symlink("/dev/full", folder / "a.new");
    folder.write("a", "old");
    const std::string said = refusal([&] { replace_text_file(folder / "a", "new"); });
    EXPECT_TRUE(holds(said, folder / "a") && holds(said, "No space left")) << said;
    EXPECT_EQ(read_text_file(folder / "a"), "old");
    EXPECT_EQ(folder.listing(), std::vector<std::string>{"a"});
}

TEST(TextFile, ThatIsMissingOrAFolderIsNamed) {
    const ScratchFolder folder;
    const std::string missing = refusal([&] { read_text_file(folder / "missing"); });
    EXPECT_TRUE(holds(missing, folder / "missing") && holds(missing, "No such file")) << missing;
    const std::string directory = refusal([&] { read_text_file(folder.path()); });
    EXPECT_TRUE(holds(directory, folder.path().string()) && holds(directory, "Is a directory")) << directory;
}

TEST(Folder, ThatTheSystemWillNotTellOfIsNone) {
    const ScratchFolder folder;
    EXPECT_TRUE(is_folder(folder.path()));
    EXPECT_FALSE(is_folder(folder / "absent"));
    EXPECT_FALSE(is_folder(folder.write("file", "")));
    EXPECT_FALSE(is_folder(folder / std::string(5000, 'x'))) << "longer than any name may be";
    std::filesystem::create_symlink("ring", folder / "ring");
    EXPECT_FALSE(is_folder(folder / "ring")) << "a link to itself";
}

TEST(Folder, IsMadeWithThoseAboveItAndMayExist) {
    const ScratchFolder folder;
    make_folder(folder / "a/b/c");
    make_folder(folder / "a/b/c");
    EXPECT_EQ(folder.listing(), (std::vector<std::string>{"a/", "a/b/", "a/b/c/"}));
    folder.write("file", "");
    EXPECT_TRUE(holds(refusal([&] { make_folder(folder / "file"); }), folder / "file"));
    EXPECT_TRUE(holds(refusal([&] { make_folder(folder / "file/inside"); }), folder / "file/inside"));
}

}  // namespace
}  // namespace eddy
