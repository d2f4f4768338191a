#pragma once
#include <stdlib.h>

#include <cstdlib>
#include <ctime>
#include <stdexcept>
#include <string>

namespace eddy {

/// The process is in this time zone until the end of the test.
class TimeZone {
  public:
    /// As TZ has it: a rule of its own, so that no database of zones is needed.
    explicit TimeZone(const char* zone) {
        const char* before = std::getenv("TZ");
        had_ = before != nullptr;
        if (had_) before_ = before;
        ::setenv("TZ", zone, 1);
        ::tzset();
    }
    ~TimeZone() {
        if (had_)
            ::setenv("TZ", before_.c_str(), 1);
        else
            ::unsetenv("TZ");
        ::tzset();
    }
    TimeZone(const TimeZone&) = delete;
    TimeZone& operator=(const TimeZone&) = delete;

  private:
    bool had_ = false;
    std::string before_;
};

/// Central Europe: clocks go from 02:00 to 03:00 on the last Sunday in March, back from 03:00 to 02:00 on the last in October.
inline constexpr const char* kBerlin = "CET-1CEST,M3.5.0,M10.5.0/3";

/// "2026-11-23 09:00:00Z" in seconds.
inline std::time_t utc(const std::string& text) {
    std::tm t{};
    const char* end = ::strptime(text.c_str(), "%Y-%m-%d %H:%M:%SZ", &t);
    if (!end || *end) throw std::invalid_argument(text);
    return ::timegm(&t);
}

}  // namespace eddy
