#include "firmware/exhibit/panel_check.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "firmware/exhibit/button.h"
#include "firmware/exhibit/panel.h"
#include "hal/gpio/find_line.h"
#include "hal/gpio/kept_line.h"

namespace eddy {
namespace {

constexpr Instant kEachLamp = std::chrono::seconds(1);

Instant as_instant(double seconds) {
    return std::chrono::duration_cast<Instant>(Seconds(seconds));
}

void list_chips(const std::vector<GpioChip>& chips, std::FILE* out) {
    if (chips.empty()) fmt::print(out, "no GPIO chip (/dev/gpiochip*) in this machine\n");
    for (const GpioChip& chip : chips) {
        if (!chip.trouble.empty()) {
            fmt::print(out, "{}: {}\n", chip.path, chip.trouble);
            continue;
        }
        fmt::print(out, "{}: '{}', {} lines\n", chip.path, chip.label, chip.lines.size());
        for (std::size_t i = 0; i < chip.lines.size(); ++i) {
            const GpioLineInfo& line = chip.lines[i];
            const std::string used = line.used ? fmt::format(", used by '{}'", line.consumer) : "";
            fmt::print(out, "  {:<24}{:<20}{}{}\n", fmt::format("{}:{}", chip.label, i), line.name,
                       line.output ? "output" : "input", used);
        }
    }
}

/// The panel, line by line.
class Check {
  public:
    Check(Gpio& gpio, const GpioConfig& config, Clock& clock, std::FILE* out,
          const std::function<bool()>& ended)
        : clock_(clock),
          out_(out),
          ended_(ended),
          button_(gpio, config.button, {.active_low = config.button_active_low}),
          stop_(gpio, config.stop, {.active_low = config.stop_active_low}),
          lamps_{KeptLine(gpio, config.lamp_green, lamp_of(config)),
                 KeptLine(gpio, config.lamp_amber, lamp_of(config)),
                 KeptLine(gpio, config.lamp_red, lamp_of(config))} {
        const Instant now = clock_.now();
        button_.read(now);
        stop_.read(now);
        for (KeptLine& lamp : lamps_) lamp.write(now, false);
        tell("button", config.button, button_);
        tell("stop", config.stop, stop_);
        for (std::size_t i = 0; i < lamps_.size(); ++i)
            tell(kLampNames[i], std::array{config.lamp_green, config.lamp_amber, config.lamp_red}[i],
                 lamps_[i]);
    }
    Check(const Check&) = delete;
    Check& operator=(const Check&) = delete;
    ~Check() { light({}); }

    bool all_is_well() const { return well_; }
    bool nothing_is_wired() const { return wired_ == 0; }

    void one_lamp_after_the_other() {
        for (std::size_t i = 0; i < lamps_.size(); ++i) {
            if (!lamps_[i].wanted() || !lamps_[i].trouble().empty()) continue;
            fmt::print(out_, "lit: {}\n", kLampNames[i]);
            std::array<bool, 3> lit{};
            lit[i] = true;
            for (const Instant end = clock_.now() + kEachLamp; clock_.now() < end && !ended_();) {
                light(lit);
                rest();
            }
        }
        light({});
    }
    void show(LampCode code, Instant time) {
        fmt::print(out_, "lamps: {}: {}\n", row_of(code).word, row_of(code).meaning);
        const Instant begin = clock_.now();
        int wired = 0;
        for (const KeptLine& lamp : lamps_) wired += lamp.wanted();
        for (Instant now = begin; now - begin < time && !ended_(); now = clock_.now()) {
            const LampStates s = lamps(code, now - begin);
            const bool one = lamp(code, now - begin);
            light(wired == 1 ? std::array{one, one, one} : std::array{s.green, s.amber, s.red});
            rest();
        }
    }
    void tell_what_is_pressed(Instant time) {
        if (!button_.wanted() && !stop_.wanted()) return;
        fmt::print(out_, "press button and stop now, for {:g} s\n", Seconds(time).count());
        Button button;
        std::optional<bool> button_was = false, stop_was = false;
        for (const Instant end = clock_.now() + time; clock_.now() < end && !ended_(); rest()) {
            const Instant now = clock_.now();
            const std::optional<bool> pressed = button_.wanted() ? button_.read(now) : false;
            const ButtonNews news = button.see(now, pressed);
            tell_change("button", button_was, pressed, button_);
            if (news.click) fmt::print(out_, "button: a click: the exhibit begins anew\n");
            if (news.guide) fmt::print(out_, "button: 3 s: guide pages\n");
            if (news.factory)
                fmt::print(out_, "button: 5 s since the start and let go: factory configuration\n");
            if (news.shutdown) fmt::print(out_, "button: 10 s and let go: shut down\n");
            tell_change("stop", stop_was, stop_.wanted() ? stop_.read(now) : false, stop_);
        }
    }

  private:
    static constexpr std::array kLampNames{"lamp_green", "lamp_amber", "lamp_red"};

    static GpioWish lamp_of(const GpioConfig& config) {
        return {.output = true, .active_low = config.lamps_active_low};
    }
    void tell(const char* key, const std::string& address, const KeptLine& line) {
        if (!line.wanted()) return fmt::print(out_, "{:<12}none\n", key);
        ++wired_;
        well_ = well_ && line.trouble().empty();
        if (line.trouble().empty())
            fmt::print(out_, "{:<12}{}\n", key, address);
        else
            fmt::print(out_, "{:<12}{}: {}\n", key, address, line.trouble());
    }
    void tell_change(const char* key, std::optional<bool>& was, std::optional<bool> is,
                     const KeptLine& line) {
        if (is == was) return;
        was = is;
        if (!is) well_ = false;
        fmt::print(out_, "{}: {}\n", key, !is ? line.trouble() : *is ? "pressed" : "not pressed");
    }
    void light(const std::array<bool, 3>& lit) {
        for (std::size_t i = 0; i < lamps_.size(); ++i) lamps_[i].write(clock_.now(), lit[i]);
    }
    void rest() { clock_.sleep_until(clock_.now() + Panel::kPeriod); }

    Clock& clock_;
    std::FILE* out_;
    const std::function<bool()>& ended_;
    KeptLine button_, stop_;
    std::array<KeptLine, 3> lamps_;
    int wired_ = 0;
    bool well_ = true;
};

}  // namespace

bool check_panel(Gpio& gpio, const GpioConfig& config, const PanelCheck& check, Clock& clock, std::FILE* out,
                 const std::function<bool()>& ended) {
    list_chips(gpio.chips(), out);
    Check panel(gpio, config, clock, out, ended);
    if (panel.nothing_is_wired()) {
        fmt::print(out, "nothing is wired: name its lines under [gpio] in /etc/eddy/exhibit.toml\n");
        return true;
    }
    if (check.code) {
        panel.show(*check.code, as_instant(check.seconds));
    } else {
        panel.one_lamp_after_the_other();
        panel.tell_what_is_pressed(as_instant(check.seconds));
    }
    return panel.all_is_well();
}

}  // namespace eddy
