#include "hal/display/kms/flip_watch.h"

namespace eddy::kms {
namespace {

using namespace std::chrono_literals;

constexpr Instant kPatience = 3s;
constexpr Instant kCured = 10s;  // of frames that come

}  // namespace

void FlipWatch::flipped(Instant now) {
    since_.reset();
    if (!well_since_) well_since_ = now;
    if (now - *well_since_ >= kCured) last_ = Cure::None;
}

FlipWatch::Cure FlipWatch::due(Instant now) {
    if (!since_ || now - *since_ < kPatience) return Cure::None;
    since_ = now;
    well_since_.reset();
    switch (last_) {
        case Cure::None:
            return last_ = Cure::SetMode;
        case Cure::SetMode:
            return last_ = Cure::Reopen;
        default:
            return last_ = Cure::GiveUp;
    }
}

}  // namespace eddy::kms
