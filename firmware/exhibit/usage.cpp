#include "firmware/exhibit/usage.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "firmware/exhibit/future.h"

namespace eddy {
namespace {

constexpr std::string_view kFirstLine = "eddy usage 1";
constexpr std::string_view kTotal = "total";

std::string date_of(std::time_t time) {
    std::tm local{};
    ::localtime_r(&time, &local);
    char text[16];
    std::strftime(text, sizeof(text), "%Y-%m-%d", &local);
    return text;
}

std::string line_of(std::string_view name, const Usage& usage) {
    std::string line(name);
    for (const UsageCounter& counter : kUsageCounters)
        line += fmt::format(" {} {}", counter.name, usage.*counter.count);
    return line + '\n';
}

/// Counters by name: an older or newer program may know others.
bool read_line(std::istringstream& words, Usage& usage) {
    std::string name;
    while (words >> name) {
        double much = 0.0;
        if (!(words >> much) || !std::isfinite(much) || much < 0.0) return false;
        for (const UsageCounter& counter : kUsageCounters)
            if (counter.name == name) usage.*counter.count = much;
    }
    return true;
}

}  // namespace

UsageBook::UsageBook(const std::filesystem::path& folder, Disk& disk) : file_(folder / "usage", disk) {
    const auto text = file_.read();
    if (text ? read(*text) : file_.unreadable() == 0) return;
    damaged_ = true;
    total_ = {};
    days_.clear();
    std::filesystem::path aside = file_.path();
    aside += ".damaged";
    std::error_code ignored;
    std::filesystem::rename(file_.path(), aside, ignored);
}

bool UsageBook::read(std::string_view text) {
    std::istringstream lines{std::string(text)};
    std::string line, name;
    if (!std::getline(lines, line) || line != kFirstLine) return false;
    bool has_total = false;
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        if (!(words >> name)) return false;
        if (name == kTotal) {
            has_total = read_line(words, total_);
            if (!has_total) return false;
        } else if (!read_line(words, days_[name])) {
            return false;
        }
    }
    return has_total;
}

void UsageBook::add(double Usage::*count, double much, std::time_t now) {
    if (!(much > 0.0)) return;
    total_.*count += much;
    days_[date_of(now)].*count += much;
    while (days_.size() > kMostDays) days_.erase(days_.begin());
    dirty_ = true;
}

bool UsageBook::go_on(Instant now) {
    const bool good = !is_ready(writing_) || fetch();
    if (dirty_ && now >= due_ && !writing_.valid()) {
        due_ = now + kEvery;
        dirty_ = false;
        writing_ = beside([this, text = text()] { return file_.try_write(text); });
    }
    return good;
}

/// Waits for what is being written; what could not be is to be written still.
bool UsageBook::fetch() {
    const bool good = writing_.get();
    dirty_ |= !good;
    return good;
}

bool UsageBook::write() {
    if (writing_.valid()) fetch();
    if (dirty_) dirty_ = !file_.try_write(text());
    return !dirty_;
}

std::string UsageBook::text() const {
    std::string text = fmt::format("{}\n{}", kFirstLine, line_of(kTotal, total_));
    for (const auto& [day, usage] : days_) text += line_of(day, usage);
    return text;
}

Usage UsageBook::on(std::time_t day) const {
    const auto found = days_.find(date_of(day));
    return found == days_.end() ? Usage{} : found->second;
}

}  // namespace eddy
