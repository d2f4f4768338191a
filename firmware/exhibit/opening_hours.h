#pragma once
#include <array>
#include <ctime>
#include <optional>
#include <string>

#include "config/opening_hours.h"
#include "hal/clock.h"

namespace eddy {

/// Whether the exhibit is open, by the civil time of the machine's zone (TZ, or /etc/localtime): what clocks on the wall show, also
/// on the days on which they change.
class OpeningHours {
  public:
    /// Throws std::invalid_argument; the settings' check has seen to it that it does not.
    explicit OpeningHours(const HoursConfig& config);

    /// With nothing written it is always open.
    bool always() const { return always_; }
    bool is_open(std::time_t now) const;
    /// When that will be another; none if not within two weeks.
    std::optional<std::time_t> next_change(std::time_t now) const;

  private:
    std::array<DayHours, 7> week_;  ///< from Sunday
    std::vector<ExceptionDay> exceptions_;
    bool always_ = false;
};

/// The exhibit's opening, as it is applied: looked at once a second, and never closed by a clock that may be wrong.
class Opening {
  public:
    explicit Opening(const HoursConfig& config) : hours_(config) {}

    struct State {
        bool open = true;
        bool clock_trusted = false;
        std::optional<std::time_t> next_change{};  ///< none: not within two weeks, or nobody knows
        bool operator==(const State&) const = default;
    };
    /// `synchronised`: the machine's clock was set by one that is right (clock_sync.h).
    const State& look(std::time_t now, bool synchronised);
    const State& state() const { return state_; }
    /// True once, when hours are written and for ten minutes of the run nobody vouched for the clock. `now`: the run's.
    bool doubts(Instant now);

  private:
    OpeningHours hours_;
    State state_;
    std::optional<std::time_t> looked_;
    bool doubted_ = false;
};

/// "open until Tuesday 17:00", for people.
std::string describe(const Opening::State& state);

}  // namespace eddy
