#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <functional>

#include "firmware/haptic/loop.h"
#include "firmware/haptic/realtime.h"
#include "firmware/verbs/real_falcon.h"
#include "firmware/verbs/stop.h"
#include "firmware/verbs/verbs.h"
#include "hal/haptic/falcon/calibration.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;
using falcon::Calibration;

FalconConfig config_for(const FalconOptions& options) {
    FalconConfig config = load_exhibit(options.config).exhibit.falcon;
    if (options.firmware) config.firmware = *options.firmware;
    if (options.serial) config.serial = *options.serial;
    return config;
}

/// Whether somebody pressed Enter since the last call.
bool enter_pressed() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    char letter = 0;
    bool pressed = false;
    while (poll(&input, 1, 0) > 0 && (input.revents & POLLIN) != 0 && read(STDIN_FILENO, &letter, 1) == 1)
        pressed = pressed || letter == '\n';
    return pressed;
}

/// A thousand times a second, says so when what the device is doing changes, and asks `tick` whether to go on. Then
/// some zeros, as the haptic loop sends them.
void drive(HapticDevice& device, const std::function<bool(Instant)>& tick) {
    grant_realtime({});
    RealClock clock;
    HapticState state = HapticState::Fault;
    std::string said;
    for (Instant due = clock.now() + kTick; !asked_to_stop(); due = std::max(due + kTick, clock.now())) {
        clock.sleep_until(due);
        const Instant now = clock.now();
        device.poll(now);
        if (device.state() != state || due % 1s < kTick) {
            state = device.state();
            if (const std::string news = fmt::format("{}: {}", to_string(state), device.describe());
                news != said)
                fmt::print(stderr, "falcon: {}\n", said = news);
        }
        if (!tick(now)) break;
    }
    for (int i = 0; i < kClosingTicks; ++i) {
        clock.sleep_until(clock.now() + kTick);
        device.poll(clock.now());
        device.command(glm::dvec3(0.0));
    }
}

bool answers(HapticState state) {
    return state == HapticState::Homing || state == HapticState::Ready;
}

void print_counters(const HapticCounters& c) {
    fmt::print("exchanges    {} good, {} timeouts\n", c.exchanges, c.timeouts);
    fmt::print("line         {} bytes dropped, {} packets with line faults, {} USB errors\n", c.bad_bytes,
               c.line_faults, c.usb_errors);
    fmt::print("start        {} tries failed, {} wrong echoes, given up {} times\n", c.failed_boots,
               c.wrong_echoes, c.given_up);
    fmt::print(
        "handle       {} jumps, {} poses not found, {} forces beyond the motors, homing lost {} times\n",
        c.implausible, c.unsolved, c.saturated, c.rehomed);
    fmt::print("plug         lost {} times\n", c.lost);
}

}  // namespace

int diagnose_falcon(const FalconOptions& options) {
    stop_on_signals();
    const auto device = make_real_falcon(config_for(options));
    // Finding and loading take their own time.
    constexpr Instant kFindTime = 2s, kStartTime = 15s;
    std::optional<Instant> answered_at;
    std::uint64_t before = 0;
    double rate = 0.0;
    std::optional<HandleReading> last;
    drive(*device, [&](Instant now) {
        if (const auto reading = device->read()) last = reading;
        device->command(glm::dvec3(0.0));
        if (!answers(device->state())) answered_at.reset();
        if (!answered_at && answers(device->state())) {
            answered_at = now;
            before = device->counters().exchanges;
        }
        if (!answered_at) return now < (device->state() == HapticState::Absent ? kFindTime : kStartTime);
        const Seconds since = now - *answered_at;
        if (since.count() < options.seconds) return true;
        rate = static_cast<double>(device->counters().exchanges - before) / since.count();
        return false;
    });
    fmt::print("state        {}\n", to_string(device->state()));
    fmt::print("device       {}\n", device->describe());
    if (rate > 0.0) fmt::print("rate         {:.0f} exchanges/s\n", rate);
    if (last)
        fmt::print(
            "handle       x {:.1f} y {:.1f} z {:.1f} mm from the middle; buttons {:04b} (left centre top "
            "right)\n",
            last->position_m.x * 1e3, last->position_m.y * 1e3, last->position_m.z * 1e3, last->buttons);
    print_counters(device->counters());
    return answers(device->state()) ? 0 : 1;
}

int calibrate_falcon(const FalconOptions& options) {
    stop_on_signals();
    const FalconConfig config = config_for(options);
    const auto device = make_real_falcon(config);
    Calibration calibration(options.weight_g * 1e-3, config.motor_units_per_nm, kLeastMotorUnitsPerNm,
                            kMostMotorUnitsPerNm);
    Calibration::Stage stage = Calibration::Stage::Done;
    drive(*device, [&](Instant now) {
        const auto reading = device->read();
        device->command(calibration.tick(now, reading));
        if (calibration.stage() == Calibration::Stage::HangOn) {
            if (enter_pressed()) calibration.weight_hangs();
        } else {
            enter_pressed();  // too early
        }
        if (stage != calibration.stage() && (reading || stage != Calibration::Stage::Done)) {
            stage = calibration.stage();
            if (stage == Calibration::Stage::Empty)
                fmt::print(stderr, "falcon: nobody touches the handle now, please, for half a minute\n");
            if (stage == Calibration::Stage::HangOn)
                fmt::print(stderr,
                           "falcon: lower {:g} g onto the handle, let it come to rest, then press Enter\n",
                           options.weight_g);
            if (stage == Calibration::Stage::Loaded)
                fmt::print(stderr, "falcon: measuring with the weight, half a minute\n");
        }
        return calibration.stage() != Calibration::Stage::Done &&
               calibration.stage() != Calibration::Stage::Failed;
    });
    if (calibration.stage() != Calibration::Stage::Done) {
        fmt::print(stderr, "falcon: not calibrated: {}\n",
                   *calibration.problem() ? calibration.problem() : "stopped");
        return 1;
    }
    fmt::print("# measured with {:g} g; the halves of the measurement are {:.1f} % of it apart\n",
               options.weight_g, calibration.spread() * 100.0);
    fmt::print("[falcon]\nmotor_units_per_nm = {:.0f}\n", calibration.motor_units_per_nm());
    fmt::print(stderr, "falcon: write the lines above into a file in {}\n",
               (std::filesystem::path(options.config) / "conf.d").string());
    return 0;
}

}  // namespace eddy
