#include "hal/haptic/falcon/calibration.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace eddy::falcon {
namespace {

using namespace std::chrono_literals;

constexpr double kGravity = 9.80665;  // [m/s2], standard

// The motors as spring, damper and slow memory. A quarter of the stiffness at which the Falcon begins to buzz
// (libnifalcon's demos use 800 to 1000 N/m), so that a wrong force scale leaves it stable.
constexpr double kStiffness = 250.0;     // [N/m]
constexpr double kDamping = 4.0;         // [N s/m]
constexpr double kMemory = 150.0;        // [N/(m s)]
constexpr double kMaxForce = 6.0;        // [N]
constexpr double kVelocityTime = 0.008;  // [s] of the low-pass on velocity
constexpr double kSwing = 0.004;         // [m] up and down
constexpr Seconds kSwingTime{2.0};
constexpr Seconds kApproachTime{2.0};  // from where the handle is found to the middle
constexpr Seconds kSettleTime{6.0};    // approach and the learning of the steady part
constexpr Seconds kHalf{8.0};          // whole swings
constexpr Seconds kMeasureTime = 2 * kHalf;
constexpr Seconds kPatience{180.0};  // for the weight
constexpr double kFarthest = 0.035;  // [m] from where it should be: it ran away
constexpr Instant kSilence = 20ms;
constexpr double kMostSpread = 0.05;

}  // namespace

Calibration::Calibration(double weight_kg, double motor_units_per_nm, double least, double most)
    : weight_n_(weight_kg * kGravity), used_(motor_units_per_nm), least_(least), most_(most) {}

void Calibration::weight_hangs() {
    if (stage_ == Stage::HangOn) weight_hangs_ = true;
}

glm::dvec3 Calibration::tick(Instant now, const std::optional<HandleReading>& reading) {
    if (stage_ == Stage::Done || stage_ == Stage::Failed) return glm::dvec3(0.0);
    if (reading) {
        if (!started_) {
            started_ = true;
            start_m_ = reading->position_m;
            begin(Stage::Empty, now);
        }
        follow(*reading);
    }
    if (!started_) return glm::dvec3(0.0);
    if (now - last_->taken_at > kSilence) {
        fail("the device stopped answering");
        return glm::dvec3(0.0);
    }
    if (stage_ == Stage::HangOn && weight_hangs_) begin(Stage::Loaded, now);

    const Seconds in_stage = now - stage_began_;
    if (stage_ == Stage::HangOn && in_stage > kPatience) {
        fail("no weight was hung on within three minutes: the motors let go");
        return glm::dvec3(0.0);
    }
    glm::dvec3 target(0.0, lift_at(in_stage), 0.0);
    if (stage_ == Stage::Empty && in_stage < kApproachTime) {
        const double share = in_stage / kApproachTime;
        target += (1.0 - share * share * (3.0 - 2.0 * share)) * start_m_;
    }
    const glm::dvec3 off = target - last_->position_m;
    if (glm::length(off) > kFarthest) {
        fail(
            "the handle ran away: nobody may touch it, the weight must be light enough, and the Falcon must "
            "stand "
            "upright");
        return glm::dvec3(0.0);
    }
    const Seconds dt = std::min<Seconds>(now - ticked_at_, Seconds(0.005));
    ticked_at_ = now;
    steady_n_ += kMemory * dt.count() * off;
    steady_n_ = glm::clamp(steady_n_, -kMaxForce, kMaxForce);
    glm::dvec3 force = steady_n_ + kStiffness * off - kDamping * velocity_m_s_;
    force *= std::min(1.0, kMaxForce / std::max(glm::length(force), 1e-9));
    if (stage_ != Stage::HangOn) measure(in_stage, force.y);
    if (stage_ == Stage::Empty && in_stage >= kSettleTime + kMeasureTime) begin(Stage::HangOn, now);
    if (stage_ == Stage::Loaded && in_stage >= kSettleTime + kMeasureTime) finish();
    return stage_ == Stage::Done || stage_ == Stage::Failed ? glm::dvec3(0.0) : force;
}

void Calibration::begin(Stage stage, Instant now) {
    stage_ = stage;
    stage_began_ = now;
    ticked_at_ = now;
}

void Calibration::fail(const char* problem) {
    stage_ = Stage::Failed;
    problem_ = problem;
}

void Calibration::follow(const HandleReading& reading) {
    if (last_ && reading.taken_at > last_->taken_at) {
        const Seconds dt = reading.taken_at - last_->taken_at;
        const glm::dvec3 raw = (reading.position_m - last_->position_m) / dt.count();
        velocity_m_s_ += (raw - velocity_m_s_) * (dt.count() / (dt.count() + kVelocityTime));
    }
    last_ = reading;
}

/// Still in the middle while it waits, else swings that begin and end there.
double Calibration::lift_at(Seconds in_stage) const {
    if (stage_ == Stage::HangOn || in_stage < kApproachTime) return 0.0;
    return kSwing *
           std::sin(2.0 * std::numbers::pi * (in_stage - kApproachTime).count() / kSwingTime.count());
}

void Calibration::measure(Seconds in_stage, double force_y_n) {
    if (in_stage < kSettleTime) return;
    const bool first = in_stage < kSettleTime + kHalf;
    if (stage_ == Stage::Empty)
        empty_.add(force_y_n);
    else
        (first ? first_half_ : second_half_).add(force_y_n);
}

void Calibration::finish() {
    const double first = first_half_.value() - empty_.value();
    const double second = second_half_.value() - empty_.value();
    const double added = (first + second) / 2.0;
    spread_ = std::abs(first - second) / weight_n_;
    // The motors give  added * used / found  newtons, and that is the weight.
    found_ = used_ * added / weight_n_;
    if (!(found_ >= least_ && found_ <= most_))
        fail("the motors did not feel the weight: was it hung on, and is the 30 V supply plugged in?");
    else if (spread_ > kMostSpread)
        fail("the handle did not come to rest: hang the weight so that it does not swing, and touch nothing");
    else
        stage_ = Stage::Done;
}

}  // namespace eddy::falcon
