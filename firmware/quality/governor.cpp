#include "firmware/quality/governor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eddy {
namespace {

/// Intervals are smoothed over about this many updates, step times over as many samples.
constexpr double kMemory = 8.0;
/// What one interval may add to the smoothed one, in periods, and one sample to the smoothed slowness, as a factor: a stall of a
/// second, however long against the period, is forgotten after two updates.
constexpr double kMostAtOnce = 2.0;
/// No machine is a hundred times slower or faster than when it was tuned; a clock that says so must not spoil the smoothed value
/// for long.
constexpr double kMostUnlikeTuned = 100.0;

bool usable(double x) {
    return std::isfinite(x) && x > 0.0;
}

double ms(Seconds t) {
    return t.count() * 1e3;
}

}  // namespace

Governor::Governor(const GovernorSetup& setup)
    : tuned_rung_(setup.tuned_rung), period_(setup.period), rung_(setup.tuned_rung), smoothed_(setup.period) {
    if (!usable(period_.count())) throw std::invalid_argument("the target period must be positive");
    if (tuned_rung_ >= setup.step_ms.size())
        throw std::invalid_argument("the tuned rung is not on the ladder");
    for (const double step_ms : setup.step_ms) {
        const Seconds step{step_ms / 1e3};
        if (!usable(step.count())) throw std::invalid_argument("the time of a step must be positive");
        if (!tuned_.empty() && step < tuned_.back())
            throw std::invalid_argument("rungs must be cheapest first");
        tuned_.push_back(step);
    }
}

std::optional<std::size_t> Governor::update(Seconds interval) {
    if (!usable(interval.count())) return std::nullopt;
    interval = std::min(interval, kLongestInterval);
    time_ += interval;
    watch_rate(interval);
    if (time_ - taken_back_ >= kForgottenAfter) wait_ = kFirstWait;

    const bool held = !rose_ && time_ - changed_ < kHold;
    if (overdue() && rung_ > 0 && !held) return step_down();
    if (room_ && room_->until - room_->since >= wait_ && !late_) return step_up();
    return std::nullopt;
}

void Governor::watch_rate(Seconds interval) {
    ++updates_;
    late_updates_ += interval > kLateShare * period_;
    smoothed_ += (std::min(interval, kMostAtOnce * period_) - smoothed_) / kMemory;
    if (const bool late = smoothed_ > kLateShare * period_; late != late_) {
        late_ = late;
        late_turned_ = time_;
        late_stretch_ = {};
    }
    if (late_) {
        Stretch& s = late_stretch_;
        s.sum += interval;
        s.worst = std::max(s.worst, interval);
        s.counted += std::min(interval, kLateAtOnce * period_);
        ++s.updates;
    }
    if (overdue() && rung_ == 0) cheapest_too_slow_ = true;
    if (!late_ && time_ - late_turned_ >= kHold) cheapest_too_slow_ = false;
}

bool Governor::overdue() const {
    return late_ && late_stretch_.counted >= std::max(kLateFor, kLatePeriods * period_);
}

// As many rungs at once as it takes: each one more would be another two seconds below the rate.
std::size_t Governor::step_down() {
    const Seconds took = late_stretch_.mean_without_worst();
    std::size_t to = rung_ - 1;
    while (to > 0 && tuned_[to] * (took / tuned_[rung_]) > kFitShare * period_) --to;
    if (rose_ && time_ - changed_ < kTakenBackWithin) {
        wait_ = std::min(2.0 * wait_, kLongestWait);
        taken_back_ = time_;
    }
    rose_ = false;
    ++steps_down_;
    reason_ = fmt::format("steps took {:.3g} ms, {:.3g} are allowed", ms(took), ms(period_));
    change_to(to);
    return to;
}

// After a step up that was a mistake, one rung at a time: the highest may be out of reach for good, the next not.
std::size_t Governor::step_up() {
    const std::size_t to = wait_ > kFirstWait ? rung_ + 1 : room_->rung;
    rose_ = true;
    ++steps_up_;
    reason_ =
        fmt::format("steps will take {:.3g} ms, {:.3g} are allowed", ms(tuned_[to] * slowness_), ms(period_));
    change_to(to);
    return to;
}

void Governor::change_to(std::size_t rung) {
    rung_ = rung;
    changed_ = late_turned_ = time_;
    late_ = cheapest_too_slow_ = false;
    room_.reset();
}

void Governor::step_took(double busy_ms) {
    if (!usable(busy_ms)) return;
    const double slowness = Seconds(busy_ms / 1e3) / tuned_[rung_];
    const double believable = std::clamp(slowness, 1.0 / kMostUnlikeTuned, kMostUnlikeTuned);
    slowness_ += (std::min(believable, kMostAtOnce * slowness_) - slowness_) / kMemory;
    const std::size_t highest = highest_with_room();
    if (highest == rung_)
        room_.reset();
    else if (room_)
        room_ = {room_->since, time_, std::min(room_->rung, highest)};
    else
        room_ = {time_, time_, highest};
}

std::size_t Governor::highest_with_room() const {
    std::size_t rung = rung_;
    while (rung + 1 < tuned_.size() &&
           tuned_[rung + 1] * slowness_ <= (rung + 1 <= tuned_rung_ ? kFitShare : kRoomShare) * period_)
        ++rung;
    return rung;
}

GovernorFigures Governor::figures() const {
    return {
        .rung = rung_,
        .steps_down = steps_down_,
        .steps_up = steps_up_,
        .late_share = updates_ > 0 ? static_cast<double>(late_updates_) / static_cast<double>(updates_) : 0.0,
        .reason = reason_,
        .trouble = cheapest_too_slow_ ? kCheapestTooSlow : std::string_view()};
}

}  // namespace eddy
