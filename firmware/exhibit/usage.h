#pragma once
#include <array>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <future>
#include <map>
#include <string>
#include <string_view>

#include "firmware/exhibit/state_file.h"
#include "hal/clock.h"

namespace eddy {

/// How much the exhibit was used, and what happened to it; nothing about any person.
struct Usage {
    double visits = 0, dwell_s = 0, force_s = 0, resets = 0, faults = 0, starts = 0, power_cuts = 0;
    bool operator==(const Usage&) const = default;
};

/// What is counted, once: the file, status.json and the metrics take it from here.
struct UsageCounter {
    double Usage::*count;
    std::string_view name;
    std::string_view meaning;
};
inline constexpr std::array<UsageCounter, 7> kUsageCounters{{
    {&Usage::visits, "visits", "visitors who touched the handle"},
    {&Usage::dwell_s, "dwell_s", "seconds from their first touch to their last"},
    {&Usage::force_s, "force_s", "seconds in which force was on"},
    {&Usage::resets, "resets", "times the scene began anew"},
    {&Usage::faults, "faults", "faults of the hand's side"},
    {&Usage::starts, "starts", "starts of the program"},
    {&Usage::power_cuts, "power_cuts", "times the machine went away under the program"},
}};

/// Keeps the counts of each day and of all time in a file of the state folder: written once a minute at most, and at the end. A
/// power cut loses the last minute and nothing else. One thread, which does not wait for the disk until the end.
class UsageBook {
  public:
    static constexpr Instant kEvery = std::chrono::minutes(1);
    /// Days that are kept by themselves; a season, so that the file stays small.
    static constexpr std::size_t kMostDays = 92;

    /// Reads what is there; a file that is damaged is put aside, and counting begins anew (damaged()).
    explicit UsageBook(const std::filesystem::path& folder, Disk& disk = real_disk());
    ~UsageBook() { write(); }
    UsageBook(const UsageBook&) = delete;
    UsageBook& operator=(const UsageBook&) = delete;

    void add(double Usage::*count, double much, std::time_t now);
    /// Begins to write, beside this thread, when something was counted and the last writing is long enough ago. False, once, if what
    /// was begun before could not be written.
    bool go_on(Instant now);
    /// Writes what is not yet written, and waits for that; false if it could not be.
    bool write();

    const Usage& total() const { return total_; }
    /// Of the day, by the clock on the wall.
    Usage on(std::time_t day) const;
    bool damaged() const { return damaged_; }

  private:
    bool read(std::string_view text);
    std::string text() const;
    bool fetch();

    StateFile file_;
    Usage total_;
    std::map<std::string, Usage> days_;  ///< by "2026-11-24"
    bool damaged_ = false, dirty_ = false;
    Instant due_{0};
    std::future<bool> writing_;
};

}  // namespace eddy
