#pragma once
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "hal/clock.h"

namespace eddy::redir {

/// What happened, one JSON object a line: "t_s" since the program began, "unix_s", "event", and what belongs to it. Each line
/// is written at once, so that whoever follows the file sees it.
class EventLog {
  public:
    /// Empty: standard output. Throws std::runtime_error if the file cannot be written.
    explicit EventLog(const std::string& path);
    ~EventLog();
    EventLog(const EventLog&) = delete;
    EventLog& operator=(const EventLog&) = delete;

    void write(Instant now, const char* event,
               nlohmann::ordered_json what = nlohmann::ordered_json::object());

  private:
    std::FILE* file_;
};

}  // namespace eddy::redir
