#include "firmware/exhibit/journal.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace eddy {
namespace {

/// More than any line needs, less than a datagram of any machine may have.
constexpr std::size_t kLongest = 32768;

/// NAME=value, or where the value has several lines: NAME, its length as eight bytes, lowest first, and the value.
void add_field(std::string& entry, std::string_view name, std::string_view value) {
    value = value.substr(0, kLongest);
    entry += name;
    if (value.find('\n') == std::string_view::npos) {
        entry += '=';
    } else {
        entry += '\n';
        for (unsigned shift = 0; shift < 64; shift += 8)
            entry += static_cast<char>((static_cast<std::uint64_t>(value.size()) >> shift) & 255u);
    }
    entry += value;
    entry += '\n';
}

}  // namespace

void StderrSink::write(const EventKind&, const std::string& message, const Fields&) {
    fmt::print(stderr, "run: {}\n", message);
}

JournalSink::JournalSink(const std::string& socket)
    : fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)), socket_(socket) {}

JournalSink::~JournalSink() {
    if (fd_ >= 0) ::close(fd_);
}

void JournalSink::write(const EventKind& kind, const std::string& message, const Fields& fields) {
    std::string entry;
    add_field(entry, "MESSAGE", message);
    add_field(entry, "MESSAGE_ID", kind.id);
    add_field(entry, "PRIORITY", fmt::format("{}", static_cast<int>(kind.priority)));
    add_field(entry, "SYSLOG_IDENTIFIER", "eddy");
    add_field(entry, "EDDY_EVENT", kind.name);
    for (const auto& [name, value] : fields) add_field(entry, name, value);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::size_t length = std::min(socket_.size(), sizeof(address.sun_path) - 1);
    std::memcpy(address.sun_path, socket_.data(), length);
    const ssize_t sent = ::sendto(fd_, entry.data(), entry.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                                  reinterpret_cast<const sockaddr*>(&address), sizeof(address));
    if (sent < 0) otherwise_.write(kind, message, fields);
}

bool is_journal(int fd, const char* journal_stream) {
    struct stat here {};
    if (!journal_stream || ::fstat(fd, &here) != 0) return false;
    return fmt::format("{}:{}", here.st_dev, here.st_ino) == journal_stream;
}

std::unique_ptr<LogSink> make_log_sink() {
    if (is_journal(STDERR_FILENO, std::getenv("JOURNAL_STREAM"))) return std::make_unique<JournalSink>();
    return std::make_unique<StderrSink>();
}

void Journal::say(Instant now, Event event, const std::string& message, const LogSink::Fields& fields) {
    go_on(now);
    if (const auto said = said_.find({event, message}); said != said_.end()) {
        ++said->second.left_out;
        return;
    }
    if (said_.size() == kMostRemembered) {
        const auto oldest = std::min_element(said_.begin(), said_.end(), [](const auto& a, const auto& b) {
            return a.second.at < b.second.at;
        });
        tell(oldest->first, oldest->second);
        said_.erase(oldest);
    }
    said_.emplace(Key{event, message}, Said{.at = now});
    write(event, message, fields);
}

void Journal::go_on(Instant now) {
    for (auto i = said_.begin(); i != said_.end();) {
        if (now - i->second.at < kQuiet) {
            ++i;
            continue;
        }
        tell(i->first, i->second);
        i = said_.erase(i);
    }
}

void Journal::flush() {
    for (const auto& [key, said] : said_) tell(key, said);
    said_.clear();
}

void Journal::tell(const Key& key, const Said& said) {
    if (said.left_out == 0) return;
    write(key.first, fmt::format("{} (and {} times more)", key.second, said.left_out),
          {{"EDDY_REPEATED", fmt::format("{}", said.left_out)}});
}

void Journal::write(Event event, const std::string& message, const LogSink::Fields& fields) {
    LogSink::Fields all = fields;
    if (!config_hash_.empty()) all.emplace_back("CONFIG_HASH", config_hash_);
    ring_->add(message);
    sink_->write(kind_of(event), message, all);
}

}  // namespace eddy
