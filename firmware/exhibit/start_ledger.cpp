#include "firmware/exhibit/start_ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace eddy {
namespace {

/// More than an hour's worth of failures: kMostRestarts times kBurst, and some.
constexpr std::size_t kMostStarts = 64;

}  // namespace

StartLedger::StartLedger(const std::filesystem::path& folder, Disk& disk)
    : file_(folder / "starts", disk), marker_(folder / "safe"), starts_(read()) {}

/// A line that is no start is left out.
std::vector<StartLedger::Start> StartLedger::read() {
    std::vector<Start> starts;
    std::istringstream lines(file_.read().value_or(""));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        Start start;
        std::string end, more;
        if (!(words >> start.at_s >> start.boot >> end) || words >> more) continue;
        const auto known = std::find(std::begin(kEnds), std::end(kEnds), end);
        if (known == std::end(kEnds)) continue;
        start.end = static_cast<End>(known - std::begin(kEnds));
        starts.push_back(start);
    }
    return starts;
}

bool StartLedger::write() {
    std::string text;
    for (const Start& start : starts_)
        text += fmt::format("{} {} {}\n", start.at_s, start.boot, kEnds[static_cast<std::size_t>(start.end)]);
    return file_.try_write(text);
}

bool StartLedger::gave_up(const std::string& boot, std::int64_t& at_s) const {
    // Those that asked for the next, too: systemd counts them like failures. They alone are spread out too far for it.
    std::vector<std::int64_t> counted;
    for (const Start& start : starts_)
        if (start.boot == boot && start.end != End::Well) counted.push_back(start.at_s);
    if (counted.size() < kBurst) return false;
    at_s = counted.back();
    return at_s - counted[counted.size() - kBurst] <= kBurst_s;
}

StartLedger::Verdict StartLedger::begin(std::int64_t now_s, const std::string& boot) {
    Verdict verdict;
    const std::string this_boot = boot.empty() ? "unknown" : boot;
    bool power_lost = !starts_.empty();
    std::string before = this_boot;
    for (auto start = starts_.rbegin(); start != starts_.rend(); ++start) {
        if (start->boot == before || start->boot == this_boot) continue;
        before = start->boot;
        std::int64_t at_s = 0;
        // One that did well ends the count: a clock that begins at the same hour each morning does not make old failures new.
        if (!gave_up(before, at_s)) break;
        if (before == starts_.back().boot) power_lost = false;
        // A clock that was set back has not made a failure undone.
        if (now_s - at_s < kHour_s) ++verdict.restarts;
    }
    if (!starts_.empty()) {
        const Start& last = starts_.back();
        power_lost = power_lost && last.boot != this_boot;
        verdict.before = last.end != End::None ? EndBefore::Well
                         : power_lost          ? EndBefore::PowerLost
                                               : EndBefore::Failed;
    }
    std::error_code error;
    verdict.asked_for = std::filesystem::exists(marker_, error);
    verdict.safe = verdict.asked_for || verdict.restarts >= kMostRestarts;
    if (!starts_.empty() && starts_.back().boot == this_boot) {
        const auto lately = std::count_if(starts_.begin(), starts_.end(), [&](const Start& start) {
            return start.boot == this_boot && now_s - start.at_s <= kBurst_s;
        });
        const bool again = starts_.back().end == End::Again && lately > 1;
        const std::int64_t step_s = verdict.safe ? kSafeStep_s : again ? kAgainStep_s : 0;
        verdict.wait_s = std::clamp<std::int64_t>(starts_.back().at_s + step_s - now_s, 0, step_s);
    }
    starts_.push_back({now_s + verdict.wait_s, this_boot, End::None});
    if (starts_.size() > kMostStarts)
        starts_.erase(starts_.begin(), starts_.end() - static_cast<std::ptrdiff_t>(kMostStarts));
    verdict.written = write();
    return verdict;
}

void StartLedger::end(End end) {
    if (starts_.empty()) return;
    starts_.back().end = end;
    write();
}

std::string boot_id() {
    std::string id;
    std::ifstream("/proc/sys/kernel/random/boot_id") >> id;
    return id;
}

}  // namespace eddy
