#include "firmware/exhibit/metrics.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "firmware/text_file.h"

namespace eddy {
namespace {

/// A text in the exposition format: each metric with what it means before it.
class Exposition {
  public:
    void gauge(std::string_view name, std::string_view help, double value) {
        head(name, help, "gauge");
        sample(name, "", value);
    }
    void counter(std::string_view name, std::string_view help, double value) {
        head(name, help, "counter");
        sample(name, "", value);
    }
    void head(std::string_view name, std::string_view help, std::string_view type) {
        text_ += fmt::format("# HELP {} {}\n# TYPE {} {}\n", name, help, name, type);
    }
    void sample(std::string_view name, std::string_view labels, double value) {
        const std::string in_braces = labels.empty() ? "" : fmt::format("{{{}}}", labels);
        if (std::isnan(value))
            text_ += fmt::format("{}{} NaN\n", name, in_braces);
        else if (std::isinf(value))
            text_ += fmt::format("{}{} {}Inf\n", name, in_braces, value > 0 ? '+' : '-');
        else
            text_ += fmt::format("{}{} {}\n", name, in_braces, value);
    }
    std::string text_{};
};

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\' || c == '"') out += '\\';
        out += c == '\n' ? ' ' : c;
    }
    return out;
}

void add_frames(Exposition& out, const FrameTimes& frames) {
    constexpr std::string_view kName = "exhibit_frame_seconds";
    out.head(kName, "How long frames took.", "histogram");
    for (std::size_t i = 0; i <= FrameTimes::kBounds_s.size(); ++i) {
        const bool all = i == FrameTimes::kBounds_s.size();
        const std::string bound = all ? "+Inf" : fmt::format("{:g}", FrameTimes::kBounds_s[i]);
        out.sample(fmt::format("{}_bucket", kName), fmt::format("le=\"{}\"", bound),
                   static_cast<double>(frames.up_to(i)));
    }
    out.sample(fmt::format("{}_sum", kName), "", frames.sum_s());
    out.sample(fmt::format("{}_count", kName), "",
               static_cast<double>(frames.up_to(FrameTimes::kBounds_s.size())));
}

}  // namespace

std::string metrics_text(const Status& s) {
    Exposition out;
    const VitalSigns& v = s.vital_signs;
    const auto number = [](auto count) { return static_cast<double>(count); };
    out.gauge("exhibit_up",
              "1 while the program writes this; how old the file is says whether it still does.", 1);
    out.head("exhibit_info", "What runs here.", "gauge");
    out.sample(
        "exhibit_info",
        fmt::format("version=\"{}\",scene=\"{}\",device=\"{}\",renderer=\"{}\",config=\"{}\"", EDDY_VERSION,
                    escaped(s.scene), escaped(s.haptic_device), escaped(s.renderer), escaped(v.config_hash)),
        1);
    out.gauge("exhibit_uptime_seconds", "Since the program's start.", s.uptime_s);
    out.head("exhibit_state", "1 for the state it is in.", "gauge");
    for (const Word<ExhibitState>& state : kExhibitStates)
        out.sample("exhibit_state", fmt::format("state=\"{}\"", state.word), v.state == state.value ? 1 : 0);
    add_frames(out, v.frames);
    out.gauge("exhibit_fluid_steps_per_second", "Steps of the fluid, as they were lately.",
              s.cost.steps_per_s);

    out.counter("exhibit_haptic_ticks_total", "Ticks of the hand's loop.", number(s.loop.ticks));
    out.counter("exhibit_haptic_tick_late_total", "Ticks that began half a millisecond late, or more.",
                number(s.loop.late));
    out.counter("exhibit_haptic_tick_missed_total", "Ticks left out because their time had passed.",
                number(s.loop.missed));
    out.gauge("exhibit_haptic_worst_late_seconds", "The latest tick since the start.",
              Seconds(s.loop.worst_late).count());
    out.counter("exhibit_force_clamp_total", "Ticks whose force was cut to the ceiling.",
                number(s.loop.gate.clamped));
    out.counter("exhibit_force_not_finite_total", "Ticks whose force was no number.",
                number(s.loop.gate.non_finite));
    out.counter("exhibit_usb_reconnect_total", "Times the device was lost.",
                number(s.loop.device_counters.lost));
    out.counter("exhibit_usb_error_total", "Errors of the bus.", number(s.loop.device_counters.usb_errors));
    out.counter("exhibit_gpu_reset_total", "Times the driver lost the picture's context.",
                number(v.gpu_resets));
    out.counter("exhibit_disk_error_total", "Times that something could not be written.",
                number(v.disk_errors));

    out.head("exhibit_guard_total", "What the guards of the fluid did (docs/guards.md).", "counter");
    for (const GuardFigure& guard : guard_figures(s))
        out.sample("exhibit_guard_total", fmt::format("guard=\"{}\"", guard.name), number(guard.count));

    out.gauge("exhibit_config_last_reload_successful", "1 if the last settings that were read were taken.",
              v.config_good ? 1 : 0);
    out.gauge("exhibit_config_last_reload_success_timestamp_seconds",
              "When settings were last taken, since 1970; 0: never.", v.config_taken_at_s);
    for (const UsageCounter& counter : kUsageCounters) {
        std::string name(counter.name);
        if (name.ends_with("_s")) name = name.substr(0, name.size() - 2) + "_seconds";
        out.counter(fmt::format("exhibit_{}_total", name),
                    fmt::format("Since it was set up: {}.", counter.meaning), v.total.*counter.count);
    }
    if (v.temperature_c)
        out.gauge("exhibit_temperature_celsius", "The hottest thermometer of the machine.", *v.temperature_c);
    out.gauge("exhibit_clock_synchronised", "1 if the opening hours are applied.",
              v.clock_synchronised ? 1 : 0);
    return out.text_;
}

bool write_metrics(const std::filesystem::path& file, const Status& status) {
    try {
        replace_text_file(file, metrics_text(status));
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

}  // namespace eddy
