#include "config/opening_hours.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace eddy {
namespace {

constexpr int kDay_min = 24 * 60;

std::string_view trimmed(std::string_view text) {
    const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

/// Calls `each` with the trimmed pieces between separators.
template <class Each>
void split(std::string_view text, std::string_view separators, const Each& each) {
    while (true) {
        const std::size_t end = text.find_first_of(separators);
        each(trimmed(text.substr(0, end)));
        if (end == std::string_view::npos) return;
        text.remove_prefix(end + 1);
    }
}

/// Exactly so many digits; below 0 if they are something else.
int digits(std::string_view text) {
    int number = 0;
    for (const char c : text) {
        if (c < '0' || c > '9') return -1;
        number = number * 10 + (c - '0');
    }
    return text.empty() ? -1 : number;
}

int parse_time(std::string_view text) {
    const int hour = text.size() == 5 && text[2] == ':' ? digits(text.substr(0, 2)) : -1;
    const int minute = hour >= 0 ? digits(text.substr(3)) : -1;
    const int time = hour * 60 + minute;
    if (hour < 0 || minute < 0 || minute > 59 || time > kDay_min)
        throw std::invalid_argument(fmt::format("'{}' is no time from 00:00 to 24:00", text));
    return time;
}

OpenRange parse_range(std::string_view text) {
    const std::size_t dash = text.find('-');
    if (dash == std::string_view::npos)
        throw std::invalid_argument(
            fmt::format("'{}' is neither a range of time, as 09:00-17:00, nor the word closed", text));
    const OpenRange range{parse_time(trimmed(text.substr(0, dash))),
                          parse_time(trimmed(text.substr(dash + 1)))};
    if (range.to_min <= range.from_min)
        throw std::invalid_argument(
            fmt::format("'{}' ends before it begins; past midnight, write two: one up to 24:00, and one from "
                        "00:00 on the next day",
                        text));
    return range;
}

std::chrono::year_month_day parse_date(std::string_view text) {
    using namespace std::chrono;
    const bool shaped = text.size() == 10 && text[4] == '-' && text[7] == '-';
    const int y = shaped ? digits(text.substr(0, 4)) : -1;
    const int m = shaped ? digits(text.substr(5, 2)) : -1;
    const int d = shaped ? digits(text.substr(8, 2)) : -1;
    const year_month_day date{year(y), month(static_cast<unsigned>(m)), day(static_cast<unsigned>(d))};
    if (y < 0 || m < 0 || d < 0 || !date.ok())
        throw std::invalid_argument(fmt::format("'{}' is no day, as 2026-12-25", text));
    return date;
}

}  // namespace

DayHours parse_day(std::string_view text) {
    text = trimmed(text);
    if (text.empty()) return {{0, kDay_min}};
    if (text == "closed") return {};
    DayHours hours;
    split(text, ",", [&](std::string_view piece) { hours.push_back(parse_range(piece)); });
    std::sort(hours.begin(), hours.end(),
              [](const OpenRange& a, const OpenRange& b) { return a.from_min < b.from_min; });
    for (std::size_t i = 1; i < hours.size(); ++i)
        if (hours[i].from_min <= hours[i - 1].to_min)
            throw std::invalid_argument(fmt::format("'{}': two ranges touch or overlap", text));
    return hours;
}

std::vector<ExceptionDay> parse_exceptions(std::string_view text) {
    std::vector<ExceptionDay> days;
    split(text, ";\n", [&](std::string_view piece) {
        if (piece.empty()) return;
        const ExceptionDay day{parse_date(piece.substr(0, 10)),
                               parse_day(piece.size() > 10 ? piece.substr(10) : "")};
        if (piece.size() > 10 && piece[10] != ' ')
            throw std::invalid_argument(fmt::format("'{}' is no day, as 2026-12-25", piece));
        for (const ExceptionDay& other : days)
            if (other.day == day.day)
                throw std::invalid_argument(fmt::format("'{}' is there twice", piece.substr(0, 10)));
        days.push_back(day);
    });
    return days;
}

}  // namespace eddy
