#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/clock.h"

namespace eddy {

// Shares of the period. What a step takes is compared with them; the gaps between them are what keeps the governor from hunting:
// no steady load makes a rung both late and worth returning to.

/// Updates further apart than this are late: the rate is below 91 % of its target.
inline constexpr double kLateShare = 1.1;
/// A rung whose steps are predicted to take this fits: for stepping down to it, and for returning up to what was tuned.
inline constexpr double kFitShare = 0.9;
/// To climb above the rung that was tuned there must be more room: nobody has tried it for long.
inline constexpr double kRoomShare = 0.7;

/// Late for this long is not chance: intervals that are each up to 30 % off do it less than once in fifty hours
/// (measured with a simulated machine, 30 to 125 updates a second).
inline constexpr Seconds kLateFor{0.5};
inline constexpr double kLatePeriods = 25.0;
/// One interval counts as no more periods of that, so that three stalls in a row do not do it either.
inline constexpr double kLateAtOnce = 4.0;
/// The first updates of all, and after a step down, tell of the change, not of the rung; no step down before that.
inline constexpr Seconds kHold{2.0};
/// There must be room for this long before a step up,
inline constexpr Seconds kFirstWait{20.0};
/// and twice as long as before, up to the longest wait, after one that had to be taken back this soon;
inline constexpr Seconds kTakenBackWithin{60.0};
inline constexpr Seconds kLongestWait{600.0};
/// until none had to be for this long.
inline constexpr Seconds kForgottenAfter{3600.0};
/// An interval counts as no more: a clock that jumped and a machine that slept say nothing about steps.
inline constexpr Seconds kLongestInterval{1.0};

inline constexpr std::string_view kCheapestTooSlow = "the cheapest setting is too slow for this machine";

struct GovernorSetup {
    std::vector<double> step_ms;  ///< of each rung, cheapest first, as measured when this machine was tuned
    std::size_t tuned_rung = 0;   ///< to start on
    Seconds period{0.0};          ///< between fluid updates at the target rate
};

struct GovernorFigures {
    std::size_t rung = 0;                        ///< 0 is the cheapest
    std::uint64_t steps_down = 0, steps_up = 0;  ///< changes of rung, however far
    double late_share = 0.0;                     ///< of all updates since start, 0 .. 1
    std::string reason{};                        ///< of the last change: "steps took 24.3 ms, 20 are allowed"
    std::string_view trouble{};                  ///< kCheapestTooSlow while that is so; otherwise empty
};

/// Keeps the rate of the fluid, which is the rate of the force, at its target by the quality of the fluid: takes it down a ladder
/// of settings when updates are late, and up again when there has been room for a while. It knows time by the intervals it is
/// told alone. GL thread only.
class Governor {
  public:
    /// Throws std::invalid_argument when the ladder is empty or not cheapest first, or a number is not finite and positive.
    explicit Governor(const GovernorSetup& setup);

    /// To be told after each fluid update the time since the last one. Returns the rung to be on from now, if that changes.
    /// An interval that is not finite and positive is ignored.
    std::optional<std::size_t> update(Seconds interval);
    /// To be told now and then (one step in twenty will do) how long a step on the present rung kept the machine busy. Without it
    /// there are no steps up. A time that is not finite and positive is ignored.
    void step_took(double busy_ms);

    GovernorFigures figures() const;

  private:
    /// A stretch of late updates.
    struct Stretch {
        Seconds sum{0.0}, worst{0.0};
        Seconds counted{0.0};  ///< sum of what each may count
        int updates = 0;
        /// The worst may be a stall.
        Seconds mean_without_worst() const { return (sum - worst) / (updates - 1); }
    };
    /// A stretch of step times that left room for a higher rung.
    struct Room {
        Seconds since, until;
        std::size_t rung;  ///< highest for which there was room all the time
    };

    void watch_rate(Seconds interval);
    bool overdue() const;
    std::size_t step_down();
    std::size_t step_up();
    void change_to(std::size_t rung);
    std::size_t highest_with_room() const;

    std::vector<Seconds> tuned_;  ///< time of a step on each rung when the machine was tuned
    std::size_t tuned_rung_;
    Seconds period_;

    Seconds time_{0.0};  ///< sum of the intervals
    std::size_t rung_;
    Seconds changed_{0.0};   ///< when the present rung was taken
    double slowness_ = 1.0;  ///< how many times longer than when tuned steps keep the machine busy, smoothed
    Seconds smoothed_;       ///< interval
    bool late_ = false;      ///< by the smoothed interval,
    Seconds late_turned_{0.0};  ///< and when that became so
    Stretch late_stretch_{};
    std::optional<Room> room_;

    Seconds wait_ = kFirstWait;
    bool rose_ = false;        ///< the last change was up
    Seconds taken_back_{0.0};  ///< when a step up last was

    bool cheapest_too_slow_ = false;
    std::uint64_t updates_ = 0, late_updates_ = 0, steps_down_ = 0, steps_up_ = 0;
    std::string reason_;
};

}  // namespace eddy
