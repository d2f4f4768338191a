#include "config/written_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <fstream>

#include "config/sha256.h"
#include "tests/config/complaints.h"

namespace eddy {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

class AFileThatIsWritten : public testing::Test {
  protected:
    void SetUp() override {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    std::vector<std::string> faults(Links links = Links::Follow) {
        read_.clear();
        return complaints([&] { read_written_file(file_, links, read_); });
    }

    const std::filesystem::path folder_ =
        testing::TempDir() + "eddy_" + testing::UnitTest::GetInstance()->current_test_info()->name();
    const std::filesystem::path file_ = folder_ / "a.toml";
    std::vector<WrittenFile> read_;
};

TEST_F(AFileThatIsWritten, IsReadWhole) {
    write("a.toml", "a = 1\n");
    EXPECT_THAT(faults(), IsEmpty());
    EXPECT_THAT(read_, ElementsAre(WrittenFile{file_, "a = 1\n"}));
}

TEST_F(AFileThatIsWritten, IsRefusedWhileItIsEmptyCutOffOrTorn) {
    write("a.toml", "");
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("a.toml: is empty;")));
    write("a.toml", "a = 1\nb = 2");
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("a.toml:2:6: seems to be cut off;")));
    EXPECT_THAT(read_, testing::SizeIs(1)) << "what was read counts, or a new try would not be noticed";
    write("a.toml", std::string("a = 1\nb\0\0\0\n", 11));
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("a.toml:2:2: a byte of 0")));
}

TEST_F(AFileThatIsWritten, IsWhatTheSumBesideItSaysIfThereIsOne) {
    write("a.toml", "a = 1\n");
    write("a.toml.sha256", sha256("a = 1\n") + "  a.toml\n");
    EXPECT_THAT(faults(), IsEmpty());
    EXPECT_THAT(read_, testing::SizeIs(2));
    write("a.toml", "a = 2\n");
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("a.toml: is not what ")));
    write("a.toml.sha256", "");
    EXPECT_THAT(faults(), testing::SizeIs(1));
}

TEST_F(AFileThatIsWritten, IsAtMostAMebibyteOfAPlainFile) {
    write("a.toml", std::string(kMostConfigBytes, '\n'));
    EXPECT_THAT(faults(), IsEmpty());
    write("a.toml", std::string(kMostConfigBytes + 1, '\n'));
    EXPECT_THAT(faults(), ElementsAre(EndsWith("is larger than 1024 KiB")));
    std::filesystem::remove(file_);
    ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
    EXPECT_THAT(faults(), ElementsAre(HasSubstr("no plain file")));
}

TEST_F(AFileThatIsWritten, IsNoLinkWhereLinksDoNotCount) {
    write("there.toml", "a = 1\n");
    std::filesystem::create_symlink("there.toml", file_);
    EXPECT_THAT(faults(), IsEmpty());
    EXPECT_THAT(faults(Links::Refuse), ElementsAre(HasSubstr("is a symbolic link;")));
}

TEST(Sha256, IsWhatSha256sumSays) {
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace eddy
