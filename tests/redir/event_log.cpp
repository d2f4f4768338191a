#include "tests/redir/event_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace eddy::redir {
namespace {

double milliseconds_of(Seconds t) {
    return std::round(t.count() * 1000.0) / 1000.0;
}

}  // namespace

EventLog::EventLog(const std::string& path) : file_(path.empty() ? stdout : std::fopen(path.c_str(), "a")) {
    if (!file_) throw std::runtime_error(fmt::format("cannot write {}: {}", path, std::strerror(errno)));
}

EventLog::~EventLog() {
    if (file_ != stdout) std::fclose(file_);
}

void EventLog::write(Instant now, const char* event, nlohmann::ordered_json what) {
    nlohmann::ordered_json line{
        {"t_s", milliseconds_of(now)},
        {"unix_s", milliseconds_of(std::chrono::system_clock::now().time_since_epoch())},
        {"event", event}};
    line.update(what);
    std::fputs((line.dump() + "\n").c_str(), file_);
    std::fflush(file_);
}

}  // namespace eddy::redir
