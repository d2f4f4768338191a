#include "firmware/exhibit/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <map>
#include <set>

#include "tests/firmware/exhibit/manager_socket.h"

namespace eddy {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using namespace std::chrono_literals;

/// An entry as the journal's own protocol has it: name, value.
std::map<std::string, std::string> parse_entry(const std::string& entry) {
    std::map<std::string, std::string> fields;
    for (std::size_t at = 0; at < entry.size();) {
        const std::size_t end = entry.find('\n', at), equals = entry.find('=', at);
        if (equals < end) {
            fields[entry.substr(at, equals - at)] = entry.substr(equals + 1, end - equals - 1);
            at = end + 1;
        } else {
            std::uint64_t size = 0;
            for (unsigned i = 0; i < 8; ++i)
                size |= static_cast<std::uint64_t>(static_cast<unsigned char>(entry.at(end + 1 + i)))
                        << (8 * i);
            fields[entry.substr(at, end - at)] = entry.substr(end + 9, size);
            EXPECT_EQ(entry.at(end + 9 + size), '\n');
            at = end + 10 + size;
        }
    }
    return fields;
}

struct Kept final : LogSink {
    explicit Kept(std::vector<std::string>& lines) : lines_(lines) {}
    void write(const EventKind& kind, const std::string& message, const Fields& fields) override {
        lines_.push_back(fmt::format("{}: {}", kind.name, message));
        for (const auto& [name, value] : fields)
            if (name == "CONFIG_HASH") lines_.back() += fmt::format(" [{}]", value);
    }
    std::vector<std::string>& lines_;
};

class JournalTest : public testing::Test {
  protected:
    std::vector<std::string> lines_;
    Journal journal_{std::make_unique<Kept>(lines_)};
};

TEST(JournalSink, SpeaksTheJournalsOwnProtocol) {
    const ScratchFolder folder;
    ManagerSocket socket(folder / "socket");
    JournalSink sink(folder / "socket");
    sink.write(kind_of(Event::DeviceLost), "the Falcon = gone", {{"CONFIG_HASH", "abc"}});
    sink.write(kind_of(Event::ConfigRejected), "first line\nsecond = line", {});
    const auto entries = socket.messages();
    ASSERT_EQ(entries.size(), 2U);
    auto first = parse_entry(entries[0]);
    EXPECT_EQ(first["MESSAGE"], "the Falcon = gone");
    EXPECT_EQ(first["MESSAGE_ID"], kind_of(Event::DeviceLost).id);
    EXPECT_EQ(first["PRIORITY"], "4");
    EXPECT_EQ(first["EDDY_EVENT"], "device_lost");
    EXPECT_EQ(first["CONFIG_HASH"], "abc");
    auto second = parse_entry(entries[1]);
    EXPECT_EQ(second["MESSAGE"], "first line\nsecond = line");
    EXPECT_EQ(second["PRIORITY"], "3");
}

TEST(JournalSink, WhatTheJournalDoesNotTakeGoesToStandardError) {
    JournalSink sink("/nonexistent/socket");
    testing::internal::CaptureStderr();
    sink.write(kind_of(Event::Note), "hello", {});
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "run: hello\n");
}

TEST(JournalStream, IsKnownByDeviceAndInode) {
    const ScratchFolder folder;
    const int fd = ::open(folder.write("stream", "").c_str(), O_RDONLY);
    struct stat here {};
    ASSERT_EQ(::fstat(fd, &here), 0);
    EXPECT_TRUE(is_journal(fd, fmt::format("{}:{}", here.st_dev, here.st_ino).c_str()));
    EXPECT_FALSE(is_journal(fd, fmt::format("{}:{}", here.st_dev, here.st_ino + 1).c_str()));
    EXPECT_FALSE(is_journal(fd, nullptr));
    EXPECT_FALSE(is_journal(-1, "0:0"));
    ::close(fd);
}

TEST_F(JournalTest, TheSameLineAgainIsCountedAndSaidOnceMore) {
    for (int i = 0; i < 500; ++i) journal_.say(i * 100ms, Event::DiskTrouble, "disk full");
    EXPECT_THAT(lines_, ElementsAre("disk_trouble: disk full"));
    journal_.go_on(59s);
    EXPECT_EQ(lines_.size(), 1U);
    journal_.go_on(60s);
    EXPECT_THAT(lines_,
                ElementsAre("disk_trouble: disk full", "disk_trouble: disk full (and 499 times more)"));
    journal_.say(61s, Event::DiskTrouble, "disk full");
    EXPECT_EQ(lines_.size(), 3U) << "a minute later it is news again";
}

TEST_F(JournalTest, OtherLinesBetweenDoNotMakeItNews) {
    for (int i = 0; i < 10; ++i) {
        journal_.say(i * 1s, Event::DeviceLost, "gone");
        journal_.say(i * 1s, Event::DeviceFound, "there");
    }
    EXPECT_THAT(lines_, ElementsAre("device_lost: gone", "device_found: there"));
}

TEST_F(JournalTest, NothingIsLostAtTheEnd) {
    {
        Journal journal(std::make_unique<Kept>(lines_));
        journal.say(0s, Event::Note, "x");
        journal.say(1s, Event::Note, "x");
    }
    EXPECT_THAT(lines_, ElementsAre("note: x", "note: x (and 1 times more)"));
}

TEST_F(JournalTest, RemembersNoMoreThanItMay) {
    for (int i = 0; i < 10000; ++i) journal_.say(1s, Event::Note, fmt::format("line {}", i));
    EXPECT_EQ(lines_.size(), 10000U);
}

TEST_F(JournalTest, EveryLineSaysWhichSettingsAreInForce) {
    journal_.say(0s, Event::Started, "a");
    journal_.set_config_hash("abc");
    journal_.say(0s, Event::Ready, "b");
    EXPECT_THAT(lines_, ElementsAre("started: a", "ready: b [abc]"));
}

TEST_F(JournalTest, TheLastTwoHundredLinesCanBeWrittenByASignalHandler) {
    for (int i = 0; i < 300; ++i) journal_.say(0s, Event::Note, fmt::format("line {}", i));
    journal_.say(0s, Event::Note, std::string(1000, 'x'));
    const ScratchFolder folder;
    const int fd = ::open((folder / "lines").c_str(), O_WRONLY | O_CREAT, 0644);
    journal_.last_lines().write_to(fd);
    ::close(fd);
    const std::string text = read_all(folder / "lines");
    EXPECT_TRUE(text.starts_with("line 101\nline 102\n")) << text.substr(0, 100);
    EXPECT_TRUE(text.ends_with("line 299\n" + std::string(LineRing::kLength - 1, 'x') + "\n"));
}

TEST(Events, HaveNamesAndIdsOfTheirOwn) {
    std::set<std::string_view> names, ids;
    for (const EventKind& kind : event_kinds()) {
        EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
        EXPECT_TRUE(ids.insert(kind.id).second) << kind.name;
        EXPECT_EQ(kind.id.size(), 32U);
        EXPECT_EQ(kind.id.find_first_not_of("0123456789abcdef"), std::string_view::npos) << kind.name;
        EXPECT_FALSE(kind.meaning.empty() || kind.what_to_do.empty()) << kind.name;
    }
}

/// Changing an id breaks whoever watches for it; here are two to remember that by.
TEST(Events, KeepTheirIds) {
    EXPECT_EQ(kind_of(Event::Ready).id, "e23300ad060d4172a8b68f2a26d1190f");
    EXPECT_EQ(kind_of(Event::ConfigRejected).id, "886e0f8bd64345399e5682ead3c32024");
}

TEST(Events, TheDocumentIsWhatTheProgramPrints) {
    EXPECT_EQ(read_all(EDDY_SOURCE_DIR "/docs/log.md"), log_reference()) << "script/report log makes it anew";
}

}  // namespace
}  // namespace eddy
