#include "firmware/exhibit/opening_hours.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace eddy {
namespace {

constexpr std::time_t kAhead_s = 14 * 86400;
/// Of a network that has yet to come up.
constexpr Instant kClockPatience = std::chrono::minutes(10);

std::tm civil(std::time_t time) {
    std::tm local{};
    ::localtime_r(&time, &local);
    return local;
}

std::chrono::year_month_day date_of(const std::tm& local) {
    return {std::chrono::year(local.tm_year + 1900),
            std::chrono::month(static_cast<unsigned>(local.tm_mon + 1)),
            std::chrono::day(static_cast<unsigned>(local.tm_mday))};
}

}  // namespace

OpeningHours::OpeningHours(const HoursConfig& c)
    : week_{parse_day(c.sunday),   parse_day(c.monday), parse_day(c.tuesday), parse_day(c.wednesday),
            parse_day(c.thursday), parse_day(c.friday), parse_day(c.saturday)},
      exceptions_(parse_exceptions(c.exceptions)) {
    const DayHours whole = parse_day("");
    always_ = exceptions_.empty() &&
              std::all_of(week_.begin(), week_.end(), [&](const DayHours& day) { return day == whole; });
}

bool OpeningHours::is_open(std::time_t now) const {
    if (always_) return true;
    const std::tm local = civil(now);
    const DayHours* hours = &week_[static_cast<std::size_t>(local.tm_wday)];
    for (const ExceptionDay& exception : exceptions_)
        if (exception.day == date_of(local)) hours = &exception.hours;
    const int minute = local.tm_hour * 60 + local.tm_min;
    return std::any_of(hours->begin(), hours->end(), [&](const OpenRange& range) {
        return minute >= range.from_min && minute < range.to_min;
    });
}

/// Minute by minute: hours begin and end with one, and so do the changes between summer and winter time, whichever way. Some 20,000
/// at most, a few milliseconds, after a change only.
std::optional<std::time_t> OpeningHours::next_change(std::time_t now) const {
    if (always_) return std::nullopt;
    const bool open = is_open(now);
    const std::time_t minute = now - civil(now).tm_sec;
    for (std::time_t t = minute + 60; t <= minute + kAhead_s; t += 60)
        if (is_open(t) != open) return t;
    return std::nullopt;
}

const Opening::State& Opening::look(std::time_t now, bool synchronised) {
    const bool clock_changed = synchronised != state_.clock_trusted;
    if (looked_ == now && !clock_changed) return state_;
    const bool jumped = looked_ && (now < *looked_ || now > *looked_ + 5);
    const bool first = !looked_;
    looked_ = now;
    if (!synchronised) {
        state_ = {};
        return state_;
    }
    const bool open = hours_.is_open(now);
    if (first || clock_changed || jumped || open != state_.open ||
        (state_.next_change && now >= *state_.next_change))
        state_ = {open, true, hours_.next_change(now)};
    return state_;
}

bool Opening::doubts(Instant now) {
    if (hours_.always() || state_.clock_trusted || now < kClockPatience) return false;
    return !std::exchange(doubted_, true);
}

std::string describe(const Opening::State& state) {
    if (!state.clock_trusted) return "open: the clock is not synchronised";
    if (!state.next_change) return state.open ? "open" : "closed";
    const std::tm local = civil(*state.next_change);
    char when[40];
    std::strftime(when, sizeof(when), "%A %H:%M", &local);
    return fmt::format("{} until {}", state.open ? "open" : "closed", when);
}

}  // namespace eddy
