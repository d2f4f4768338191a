#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/exhibit/events.h"
#include "firmware/exhibit/line_ring.h"
#include "hal/clock.h"

namespace eddy {

/// Where lines go.
class LogSink {
  public:
    virtual ~LogSink() = default;
    using Fields = std::vector<std::pair<std::string, std::string>>;
    virtual void write(const EventKind& kind, const std::string& message, const Fields& fields) = 0;
};

/// Lines on standard error, "run: message", as people at a terminal read them.
class StderrSink final : public LogSink {
  public:
    void write(const EventKind& kind, const std::string& message, const Fields& fields) override;
};

/// The system's journal by its own protocol, with fields: one datagram an entry. What does not get through goes to standard error.
class JournalSink final : public LogSink {
  public:
    static constexpr const char* kSocket = "/run/systemd/journal/socket";
    explicit JournalSink(const std::string& socket = kSocket);
    ~JournalSink() override;
    JournalSink(const JournalSink&) = delete;
    JournalSink& operator=(const JournalSink&) = delete;
    void write(const EventKind& kind, const std::string& message, const Fields& fields) override;

  private:
    int fd_;
    std::string socket_;
    StderrSink otherwise_;
};

/// Whether `fd` is the stream to the journal that `journal_stream` names, as JOURNAL_STREAM has it ("device:inode"; null if it is not
/// there).
bool is_journal(int fd, const char* journal_stream);
/// The journal if standard error goes there, else standard error.
std::unique_ptr<LogSink> make_log_sink();

/// The log of the exhibit. The same line again within a minute is counted and said once more at the end of it, with how often.
/// One thread.
class Journal {
  public:
    static constexpr Instant kQuiet = std::chrono::minutes(1);
    /// Lines that are remembered as said; beyond, the oldest are forgotten.
    static constexpr std::size_t kMostRemembered = 64;

    explicit Journal(std::unique_ptr<LogSink> sink) : sink_(std::move(sink)) {}
    ~Journal() { flush(); }

    void say(Instant now, Event event, const std::string& message, const LogSink::Fields& fields = {});
    /// Says how often lines were left out, when their minute is over. A few times a minute.
    void go_on(Instant now);
    /// The same for all of them, at the end.
    void flush();

    /// Goes with every line from now on.
    void set_config_hash(std::string hash) { config_hash_ = std::move(hash); }
    /// The last lines, for a crash record.
    const LineRing& last_lines() const { return *ring_; }

  private:
    struct Said {
        Instant at{0};
        std::uint64_t left_out = 0;
    };
    using Key = std::pair<Event, std::string>;
    void write(Event event, const std::string& message, const LogSink::Fields& fields);
    void tell(const Key& key, const Said& said);

    std::unique_ptr<LogSink> sink_;
    std::map<Key, Said> said_;
    std::string config_hash_;
    std::unique_ptr<LineRing> ring_ = std::make_unique<LineRing>();
};

}  // namespace eddy
