#include "firmware/exhibit/office.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "firmware/exhibit/metrics.h"
#include "firmware/exhibit/process_age.h"
#include "firmware/run_summary.h"
#include "firmware/text_file.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

constexpr Instant kReportEvery = 1s;

Event event_of(DisplayState screen) {
    switch (screen) {
        case DisplayState::Showing:
            return Event::ScreenFound;
        case DisplayState::NoMonitor:
        case DisplayState::Moved:
        case DisplayState::Lost:
            return Event::ScreenLost;
        case DisplayState::Asleep:
            break;
    }
    return Event::Note;
}

}  // namespace

Office::Office(const Clock& clock)
    : clock_(clock),
      journal_(make_log_sink()),
      notify_(ServiceNotify::from_environment()),
      service_(notify_, watchdog_period()) {}

void Office::say(Event event, const std::string& message, const LogSink::Fields& fields) {
    journal_.say(clock_.now(), event, message, fields);
}

void Office::say_when(Event event, const std::string& message) {
    const std::string after = fmt::format("{:.2f}", process_age().value_or(clock_.now()).count());
    say(event, fmt::format("{}, {} s after the start", message, after), {{"EDDY_AFTER_S", after}});
}

void Office::disk_trouble(const std::string& what) {
    ++disk_errors_;
    say(Event::DiskTrouble, what);
}

void Office::count_in(const std::filesystem::path& state_dir) {
    usage_.emplace(state_dir);
    if (usage_->damaged())
        disk_trouble("the usage counts were damaged: they are put aside, and counting begins anew");
}

void Office::count(double Usage::*what, double much) {
    if (usage_) usage_->add(what, much, wall_time());
}

void Office::tell_news(Front& front, HandSide& hand) {
    if (front.plays())
        for (const std::string& line : front.act().news()) say(Event::QualityChanged, line);
    if (const auto news = hand.grant_news()) say(Event::Note, *news);
    if (const auto news = hand.flight_news()) say(Event::FlightKept, *news);
    if (const auto news = front.news()) say(event_of(news->state), news->text);
    if (front.gpu_resets() > gpu_resets_) {
        gpu_resets_ = front.gpu_resets();
        say(Event::GpuReset,
            fmt::format("the GPU was reset: the picture is made anew (reset {})", gpu_resets_));
    }
    tell_of_hand(hand);
}

void Office::tell_of_hand(const HandSide& hand) {
    const LoopReport& loop = hand.report();
    if (hand.has_device() && loop.device != device_) {
        const bool ready = loop.device == HapticState::Ready;
        if (ready || device_ == HapticState::Ready || loop.device == HapticState::Fault) {
            say(ready ? Event::DeviceFound : Event::DeviceLost,
                fmt::format("the hand's device is {}", to_string(loop.device)));
            if (!ready) count(&Usage::faults);
        }
        device_ = loop.device;
    }
    if (loop.reason != force_) {
        const auto grave = {GateReason::Stopped, GateReason::DeviceSilent, GateReason::NotFinite};
        if (std::find(grave.begin(), grave.end(), loop.reason) != grave.end())
            say(Event::ForceOff, std::string(to_string(loop.reason)));
        force_ = loop.reason;
    }
}

bool Office::report(Instant now, const View& view, bool finally) {
    if (now < report_due_ && !finally) return false;
    report_due_ = now + kReportEvery;
    temperature_c_ = temperature_c();
    journal_.go_on(now);
    if (usage_) {
        if (view.hand.report().reason == GateReason::Open)
            count(&Usage::force_s, Seconds(kReportEvery).count());
        if (!usage_->go_on(now)) disk_trouble("the usage counts could not be written");
    }
    if (const int unwritten = view.settings.failed_writes;
        unwritten > std::exchange(settings_unwritten_, unwritten))
        disk_trouble("what is remembered of the settings could not be written: " + view.settings.trouble);
    if (view.front.plays()) write_figures(now, view);
    return true;
}

void Office::write_figures(Instant now, const View& view) {
    Status status = status_of(view.front.act(), view.front.graphics(), view.hand);
    status.uptime_s = Seconds(now).count();
    status.vital_signs = vital_signs(view);
    service_.say(now, fmt::format("{}, {:.0f} steps/s, force: {}", to_word(status.vital_signs.state),
                                  status.cost.steps_per_s, to_word(view.hand.report().reason)));
    const std::filesystem::path& run_dir = view.exhibit.run_dir;
    if (!is_folder(run_dir)) return;
    const std::string& metrics = view.exhibit.unattended.metrics_file;
    const std::filesystem::path prom =
        metrics.empty() ? run_dir / "eddy.prom" : std::filesystem::path(metrics);
    if (!write_status(run_dir / "status.json", status)) disk_trouble("status.json could not be written");
    if (!write_metrics(prom, status)) disk_trouble(prom.string() + " could not be written");
}

VitalSigns Office::vital_signs(const View& view) const {
    VitalSigns signs;
    signs.state = exhibit_state(view.facts);
    signs.opening = describe(view.opening.state());
    signs.clock_synchronised = view.clock_sync.synchronised();
    signs.frames = frame_times_;
    if (usage_) {
        signs.total = usage_->total();
        signs.today = usage_->on(wall_time());
    }
    signs.config_good = view.settings_good;
    signs.config_taken_at_s = view.settings_taken_at_s;
    signs.config_hash = view.settings.running_hash;
    signs.disk_errors = disk_errors_;
    signs.gpu_resets = view.front.gpu_resets();
    signs.temperature_c = temperature_c_;
    return signs;
}

std::vector<std::string> Office::guide_page(const View& view) const {
    const VitalSigns signs = vital_signs(view);
    const LoopReport& loop = view.hand.report();
    return {fmt::format("Eddy {}: {}", EDDY_VERSION, to_word(signs.state)),
            fmt::format("Scene: {}. {}.", view.scene.title, signs.opening),
            fmt::format("Handle: {}; {}.", to_string(loop.device), to_string(loop.reason)),
            fmt::format("Settings: {}{}.", to_word(view.settings.source),
                        view.settings_good ? "" : "; the newest were refused, see config.json"),
            fmt::format("Today: {:.0f} visits, {:.0f} faults.", signs.today.visits, signs.today.faults),
            view.trouble.empty() ? "Button and lamps: well."
                                 : "Button and lamps: " + view.trouble.substr(0, view.trouble.find('\n')),
            "Click: back to the show. Ten seconds: switch off."};
}

void Office::close() {
    if (usage_ && !usage_->write()) disk_trouble("the usage counts could not be written");
    journal_.flush();
}

}  // namespace eddy
