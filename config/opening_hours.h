#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace eddy {

/// [hours] of an exhibit, as written.
struct HoursConfig {
    std::string monday{}, tuesday{}, wednesday{}, thursday{}, friday{}, saturday{}, sunday{};
    std::string exceptions{};
    bool operator==(const HoursConfig&) const = default;
};

/// When it is open on a day: from one minute of the day on, up to another.
struct OpenRange {
    int from_min = 0, to_min = 0;
    bool operator==(const OpenRange&) const = default;
};
using DayHours = std::vector<OpenRange>;  ///< none: closed; in order, none touches another

/// "09:00-12:00, 13:00-17:00", "closed", or nothing for a whole day. Throws std::invalid_argument, saying what is wrong.
DayHours parse_day(std::string_view text);

/// A day that is not like others of its weekday.
struct ExceptionDay {
    std::chrono::year_month_day day{};
    DayHours hours;
    bool operator==(const ExceptionDay&) const = default;
};

/// "2026-12-24 09:00-12:00; 2026-12-25 closed"; a line end will do for a semicolon. Throws std::invalid_argument.
std::vector<ExceptionDay> parse_exceptions(std::string_view text);

}  // namespace eddy
