#include "hal/haptic/falcon/falcon.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "hal/haptic/falcon/firmware_image.h"

namespace eddy {
namespace {

using namespace falcon;
using namespace std::chrono_literals;

// What the chip is told before frames are exchanged (libnifalcon FalconCommLibUSB.cpp). A device just found
// is purged first; the event character comes last, so that it can be left out.
constexpr ControlRequest kRunTime[] = {
    purge_receiver(), purge_transmitter(), set_latency(1), baud_1500000(),
    purge_receiver(), purge_transmitter(), flush_on('>'),
};
constexpr std::size_t kFirstPurges = 2;

constexpr Instant kAttachTime = 1s;    // libnifalcon's time-out for control requests
constexpr Instant kProbeTime = 200ms;  // about fifteen unanswered frames; a running Falcon answers the first
constexpr Instant kBootTime = 10s;     // radarsat1/dimple issue 4 found less to be too short
constexpr int kMaxBoots = 10;          // as libnifalcon's command line, vrpn and HAPI
constexpr Instant kFaultTime = 5s;     // until the next try; somebody may have plugged in the power supply
constexpr Instant kLostTime = 1200ms;  // of silence: a hundred unanswered commands (gborghesan/novint_falcon)
constexpr Instant kHomedTime = 500ms;  // encoders jump when an axis finds its index: no force until they rest
constexpr int kIdlePolls = 3;          // Ready but not commanded: zero is sent, so that positions keep coming

constexpr Instant kForever = Instant::max();

const char* sentence_for(Obstacle obstacle) {
    switch (obstacle) {
        case Obstacle::NotFound:
            return "no Novint Falcon (USB 0403:cb48) found: plug it in";
        case Obstacle::OtherSerial:
            return "there is a Novint Falcon (USB 0403:cb48), but not the one with the serial asked for";
        case Obstacle::Denied:
            return "there is a Novint Falcon (USB 0403:cb48) that this user may not open: install the udev "
                   "rule "
                   "60-eddy.rules and plug it in again";
        case Obstacle::Busy:
            return "there is a Novint Falcon (USB 0403:cb48) that another program uses: end that program";
        case Obstacle::Unusable:
            return "there is a Novint Falcon (USB 0403:cb48) that cannot be opened: plug it in again";
    }
    return "no Novint Falcon";
}

}  // namespace

Falcon::Falcon(std::unique_ptr<Transport> transport, FalconSettings settings)
    : transport_(std::move(transport)),
      settings_(std::move(settings)),
      exchange_(*transport_),
      boot_(*transport_, settings_.firmware_image) {
    if (settings_.firmware_image.empty()) return;
    if (const auto problem = problem_in_firmware(settings_.firmware_image))
        throw std::invalid_argument(*problem);
}

Falcon::~Falcon() {
    const bool frames_are_heard = step_ == Step::Homing || step_ == Step::Ready;
    if (frames_are_heard)
        transport_->close(encode(Command{}));
    else
        transport_->close({});
}

void Falcon::poll(Instant now) {
    now_ = now;
    transport_->poll(now);
    if (step_ != Step::Absent && !transport_->present()) lose();

    // Booting reads the line itself; in all other states what arrives are replies.
    std::optional<Reply> reply;
    if (step_ == Step::Probing || step_ == Step::Homing || step_ == Step::Ready) {
        const int misses = exchange_.misses();
        reply = exchange_.poll(now);
        if (exchange_.misses() > misses) {
            zero_next_ = true;
            if (step_ != Step::Probing) ++counters_.timeouts;
        }
        if (reply) {
            ++counters_.exchanges;
            replied_at_ = exchange_.reply_arrived_at();
        }
        if (step_ != Step::Probing && now - *replied_at_ > kLostTime) lose();
    }

    switch (step_) {
        case Step::Absent:
            return absent();
        case Step::Attaching:
            return attaching();
        case Step::Probing:
            return probing(reply.has_value());
        case Step::Booting:
            return booting();
        case Step::Homing:
            return homing(reply);
        case Step::Ready:
            return ready(reply);
        case Step::Fault:
            return fault();
    }
}

void Falcon::absent() {
    if (!transport_->present()) return;
    loaded_ = false;
    attach();
}

void Falcon::attaching() {
    const Progress progress = requests_.poll(*transport_);
    if (progress == Progress::Done)
        probe();
    else if (progress == Progress::Failed || now_ > deadline_)
        boot_failed();
}

void Falcon::probing(bool answered) {
    if (answered) {
        failed_boots_ = 0;
        was_unhomed_ = false;
        homed_since_.reset();
        enter(Step::Homing, kForever);  // it takes a person to home it; only silence ends the wait
    } else if (now_ > deadline_) {
        if (loaded_)
            boot_failed();
        else if (settings_.firmware_image.empty())
            probe();
        else
            boot();
    } else if (exchange_.free()) {
        send({});
    }
}

void Falcon::booting() {
    const Progress progress = boot_.poll(now_);
    if (progress == Progress::Done) {
        loaded_ = true;
        attach();
    } else if (progress == Progress::Failed || now_ > deadline_) {
        boot_failed();
    }
}

void Falcon::homing(const std::optional<Reply>& reply) {
    if (reply) {
        if (!reply->all_homed()) {
            was_unhomed_ = true;
            homed_since_.reset();
        } else if (!homed_since_) {
            homed_since_ = now_;
        }
        if (homed_since_ && (!was_unhomed_ || now_ - *homed_since_ >= kHomedTime)) become_ready();
    }
    if (exchange_.free()) send({});
}

void Falcon::ready(const std::optional<Reply>& reply) {
    if (reply) {
        if (settings_.keep_homing_bit && !reply->all_homed()) {
            ++counters_.rehomed;
            was_unhomed_ = true;
            homed_since_.reset();
            enter(Step::Homing, kForever);
            reading_.reset();
            return homing(std::nullopt);
        }
        take(*reply);
    }
    // A force is for command() to send, later in this tick.
    const bool idle = ++idle_polls_ > kIdlePolls;
    if (exchange_.free() && (zero_next_ || idle)) send({});
}

void Falcon::fault() {
    if (now_ < deadline_) return;
    failed_boots_ = 0;
    enter(Step::Absent, kForever);
}

void Falcon::enter(Step step, Instant time_allowed) {
    step_ = step;
    deadline_ = time_allowed == kForever ? kForever : now_ + time_allowed;
}

void Falcon::attach() {
    std::span<const ControlRequest> list = kRunTime;
    if (!settings_.flush_on_frame_end) list = list.first(list.size() - 1);
    requests_.start(loaded_ ? list.subspan(kFirstPurges) : list);
    enter(Step::Attaching, kAttachTime);
}

void Falcon::probe() {
    exchange_.reset();
    enter(Step::Probing, kProbeTime);
}

void Falcon::boot() {
    boot_.start(now_);
    enter(Step::Booting, kBootTime);
}

void Falcon::boot_failed() {
    loaded_ = false;
    ++counters_.failed_boots;
    if (++failed_boots_ >= kMaxBoots) {
        ++counters_.given_up;
        enter(Step::Fault, kFaultTime);
    } else if (settings_.firmware_image.empty()) {
        attach();
    } else {
        boot();
    }
}

void Falcon::become_ready() {
    tracker_.forget();
    reading_.reset();
    idle_polls_ = 0;
    enter(Step::Ready, kForever);
}

void Falcon::lose() {
    ++counters_.lost;
    reading_.reset();
    exchange_.reset();
    enter(Step::Absent, kForever);
}

void Falcon::take(const Reply& reply) {
    const Instant at = exchange_.reply_arrived_at();
    const std::uint8_t buttons = buttons_.push(reply.buttons, at);
    switch (tracker_.take(reply.encoders, at)) {
        case Tracker::Outcome::Implausible:
            ++counters_.implausible;
            break;
        case Tracker::Outcome::Unsolved:
            ++counters_.unsolved;
            break;
        case Tracker::Outcome::Followed:
            reading_ = HandleReading{.position_m = tracker_.position_m(), .buttons = buttons, .taken_at = at};
            break;
    }
}

std::optional<HandleReading> Falcon::read() {
    return std::exchange(reading_, std::nullopt);
}

void Falcon::command(const glm::dvec3& force_n) {
    if (step_ != Step::Ready) return;
    idle_polls_ = 0;
    if (exchange_.free()) send_force(force_n);
}

bool Falcon::obeys() const {
    return step_ == Step::Ready && exchange_.trusted() && tracker_.legs(now_).has_value();
}

void Falcon::send_force(const glm::dvec3& force_n) {
    const bool finite = std::isfinite(force_n.x) && std::isfinite(force_n.y) && std::isfinite(force_n.z);
    if (!finite || !obeys()) return send({});
    const MotorForce force = motors_for(*tracker_.legs(now_), force_n, settings_.motor_units_per_nm);
    if (force.saturated) ++counters_.saturated;
    send(force.motors);
}

void Falcon::send(const Axes& motors) {
    const bool homed = step_ == Step::Ready;
    const HandleLight light = homed ? light_ : HandleLight{.red = true};
    exchange_.send({.motors = homed ? motors : Axes{},
                    .homing = !homed || settings_.keep_homing_bit,
                    .red = light.red,
                    .green = light.green,
                    .blue = light.blue},
                   now_);
    zero_next_ = false;
}

HapticState Falcon::state() const {
    switch (step_) {
        case Step::Absent:
            return HapticState::Absent;
        case Step::Attaching:
        case Step::Probing:
            return loaded_ ? HapticState::Loading : HapticState::Booting;
        case Step::Booting:
            return boot_.uploading() ? HapticState::Loading : HapticState::Booting;
        case Step::Homing:
            return HapticState::Homing;
        case Step::Ready:
            return HapticState::Ready;
        case Step::Fault:
            return HapticState::Fault;
    }
    return HapticState::Fault;
}

HapticCounters Falcon::counters() const {
    HapticCounters counters = counters_;
    counters.bad_bytes = exchange_.dropped_bytes();
    counters.line_faults = exchange_.line_faults();
    counters.usb_errors = transport_->failures();
    counters.wrong_echoes = boot_.wrong_echoes();
    return counters;
}

Seconds Falcon::silence(Instant now) const {
    if (!replied_at_) return Seconds(std::numeric_limits<double>::infinity());
    return now - *replied_at_;
}

std::string Falcon::describe() const {
    if (step_ == Step::Absent) return sentence_for(transport_->obstacle());
    const auto doing = [this]() -> std::string {
        switch (step_) {
            case Step::Attaching:
            case Step::Probing:
                if (!loaded_ && settings_.firmware_image.empty())
                    return "no firmware runs in it and none is set: give the path of Novint's firmware image "
                           "in falcon.firmware";
                return "asking whether its firmware runs";
            case Step::Booting:
                return boot_.uploading() ? "uploading the firmware"
                                         : "calling its boot program; 30 V supply plugged in?";
            case Step::Homing:
                return "waiting to be homed: pull the handle fully out, then push it fully in; if that "
                       "does not help, plug in its 30 V supply";
            case Step::Ready:
                return "ready";
            case Step::Fault:
                return fmt::format("gave up after {} tries to start it; trying again soon", kMaxBoots);
            case Step::Absent:
                break;
        }
        return "absent";
    };
    return fmt::format("Novint Falcon {}: {} ({} line faults)", transport_->serial(), doing(),
                       exchange_.line_faults());
}

}  // namespace eddy
