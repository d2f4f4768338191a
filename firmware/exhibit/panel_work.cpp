#include "firmware/exhibit/panel_work.h"

#include <utility>

namespace eddy {
namespace {

GpioWish lamp_of(const GpioConfig& config) {
    return {.output = true, .active_low = config.lamps_active_low};
}

}  // namespace

PanelWork::PanelWork(Gpio& gpio, const GpioConfig& config, const std::filesystem::path& stop_file)
    : button_line_(gpio, config.button, {.active_low = config.button_active_low}),
      stop_(gpio, config.stop, {.active_low = config.stop_active_low}),
      green_(gpio, config.lamp_green, lamp_of(config)),
      amber_(gpio, config.lamp_amber, lamp_of(config)),
      red_(gpio, config.lamp_red, lamp_of(config)),
      stopped_(stop_.wanted()),
      stop_memory_(stop_file),
      stop_input_(stop_.wanted()) {}

void PanelWork::work(Instant now) {
    see_stop(now);
    see_button(now);
    light(now);
    tell();
    beats_.fetch_add(1, std::memory_order_relaxed);
}

// Pressed at once, let go with deliberation; what cannot be read is pressed.
void PanelWork::see_stop(Instant now) {
    if (!stop_.wanted()) return;
    const std::optional<bool> pressed = stop_.read(now);
    const bool first = pressed && !stop_seen_;
    if (pressed.value_or(true)) {
        stop_pressed_at_ = now;
        stopped_ = true;
    } else if (first || now - stop_pressed_at_ >= kStopRests) {
        stopped_ = false;
    }
    // As of before the look: a line that answers late tells of then.
    stop_input_.found(stopped_, now);
    // However late the clicks from before it are heard.
    if (stopped_) {
        const std::lock_guard lock(mutex_);
        news_.force_back = false;
    }
    if (pressed) stop_seen_ = true;
    // A line that has not come up yet was not pressed by anybody.
    if (stopped_ && stop_seen_) stop_memory_.pressed();
}

void PanelWork::see_button(Instant now) {
    const ButtonNews news = button_.see(now, button_line_.wanted() ? button_line_.read(now) : std::nullopt);
    if (!news.click && !news.guide && !news.shutdown && !news.factory) return;
    const std::lock_guard lock(mutex_);
    if (news.click) ++news_.resets;
    if (news.click && !stopped_) {
        news_.force_back = true;
        stop_memory_.clicked();
    }
    news_.guide |= news.guide;
    news_.shutdown |= news.shutdown;
    news_.factory |= news.factory;
}

LampCode PanelWork::code_now() const {
    if (stopped_) return LampCode::Stopped;
    switch (button_.phase()) {
        case Button::Phase::Guide:
            return LampCode::Guide;
        case Button::Phase::Shutdown:
        case Button::Phase::Factory:
            return LampCode::LetGo;
        case Button::Phase::Stuck:
            return LampCode::Fault;
        case Button::Phase::Up:
        case Button::Phase::Down:
            break;
    }
    return asked_.load(std::memory_order_relaxed);
}

void PanelWork::light(Instant now) {
    player_.show(code_now());
    player_.advance(now);
    const LampCode code = player_.code();
    const Instant shown = player_.shown();
    LampStates states = lamps(code, shown);
    if (const int wired = green_.wanted() + amber_.wanted() + red_.wanted(); wired == 1)
        states.green = states.amber = states.red = lamp(code, shown);
    green_.write(now, states.green);
    amber_.write(now, states.amber);
    red_.write(now, states.red);
}

void PanelWork::darken(Instant now) {
    for (KeptLine* line : {&green_, &amber_, &red_}) line->write(now, false);
}

void PanelWork::tell() {
    const std::lock_guard lock(mutex_);
    ring_ = ring(player_.code(), player_.shown());
    news_.button_stuck = button_.phase() == Button::Phase::Stuck;
    news_.trouble.clear();
    for (const KeptLine* line : {&stop_, &button_line_, &green_, &amber_, &red_}) {
        if (line->trouble().empty()) continue;
        if (!news_.trouble.empty()) news_.trouble += '\n';
        news_.trouble += line->trouble();
    }
}

HandleLight PanelWork::handle_light() const {
    const std::lock_guard lock(mutex_);
    return ring_;
}

PanelNews PanelWork::news() {
    const std::lock_guard lock(mutex_);
    PanelNews news = news_;
    news_.resets = 0;
    news_.force_back = news_.guide = news_.shutdown = news_.factory = false;
    return news;
}

}  // namespace eddy
