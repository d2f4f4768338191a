#include "firmware/stability/random_hand.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace eddy::stability {
namespace {

/// The handle of a Falcon reaches some 50 mm each way.
constexpr double kReachM = 0.05;
/// Darting, in any direction anew at each reading; a hand that slips reaches a tenth of it.
constexpr double kDartM_S = 10.0;

}  // namespace

void RandomHand::begin_act(Instant now) {
    using enum Act;
    act_ = draw_.one_of({Rests, Stirs, Stirs, Stirs, Trembles, Darts, Leaps, Nonsense, Silent, Away});
    began_ = now;
    ends_ = now + std::chrono::duration_cast<Instant>(Seconds(draw_.scale(0.01, 2.0)));
    from_m_ = at_m_;
    swing_m_ = draw_.vector(kReachM) - (act_ == Trembles ? glm::dvec3(0.0) : from_m_);
    if (act_ == Trembles) swing_m_ *= 0.3;
    turns_per_s_ = act_ == Trembles ? draw_.between(8.0, 500.0) : draw_.between(0.1, 2.0);
    state_ = act_ != Away ? HapticState::Ready
                          : draw_.one_of({HapticState::Absent, HapticState::Booting, HapticState::Loading,
                                          HapticState::Homing, HapticState::Fault});
}

glm::dvec3 RandomHand::nonsense_m() {
    glm::dvec3 nonsense = at_m_;
    nonsense[draw_.whole(0, 2)] =
        draw_.one_of({std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                      -1e30, 1e300, 1e-320});
    return nonsense;
}

glm::dvec3 RandomHand::position_m(Seconds since) {
    switch (act_) {
        case Act::Stirs:
        case Act::Trembles:
            return from_m_ + swing_m_ * std::sin(2.0 * std::numbers::pi * turns_per_s_ * since.count());
        case Act::Darts:
            return glm::clamp(at_m_ + draw_.vector(kDartM_S * 1e-3), glm::dvec3(-2.0 * kReachM),
                              glm::dvec3(2.0 * kReachM));
        case Act::Leaps:
            return draw_.chance(0.05) ? draw_.vector(draw_.chance(0.8) ? kReachM : 100.0) : at_m_;
        case Act::Rests:
        case Act::Nonsense:
        case Act::Silent:
        case Act::Away:
            break;
    }
    return at_m_;
}

void RandomHand::poll(Instant now) {
    if (now >= ends_) begin_act(now);
    reading_.reset();
    if (act_ == Act::Silent || act_ == Act::Away) return;
    at_m_ = position_m(now - began_);
    reading_ = HandleReading{act_ == Act::Nonsense ? nonsense_m() : at_m_,
                             static_cast<std::uint8_t>(draw_.whole(0, 15)), now};
    answered_ = now;
}

std::optional<HandleReading> RandomHand::read() {
    return std::exchange(reading_, std::nullopt);
}

Seconds RandomHand::silence(Instant now) const {
    if (!answered_) return Seconds(std::numeric_limits<double>::infinity());
    return now - *answered_;
}

}  // namespace eddy::stability
