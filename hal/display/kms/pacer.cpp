#include "hal/display/kms/pacer.h"

#include <algorithm>

namespace eddy::kms {
namespace {

/// Flips that wait for the refresh are whole periods apart: one in many may be stamped early, a tenth of them never.
constexpr int kSample = 30, kFast = 10;

}  // namespace

void Pacer::flipped(Instant sent, Instant time) {
    const Instant from = last_ ? std::max(sent, *last_) : sent;
    late_ = period_ > Instant(0) && time - from > period_ * 3 / 2;
    if (last_ && period_ > Instant(0) && !unpaced_) {
        ++seen_;
        if (time - *last_ < period_ * 85 / 100) ++fast_;
        if (fast_ >= kFast) unpaced_ = true;
        if (seen_ >= kSample) seen_ = fast_ = 0;
    }
    // Evenly on from when the last was due, so that what a frame is late by does not add up; after a pause, from now.
    const bool goes_on = due_ && time >= *due_ && time - *due_ < period_;
    due_ = (goes_on ? *due_ : time) + period_;
    last_ = time;
}

std::optional<Instant> Pacer::next() const {
    return unpaced_ ? due_ : std::nullopt;
}

}  // namespace eddy::kms
