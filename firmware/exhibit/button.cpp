#include "firmware/exhibit/button.h"

namespace eddy {

ButtonNews Button::see(Instant now, std::optional<bool> closed) {
    ButtonNews news;
    if (!closed) {
        closed_ = down_ = false;
        closed_since_ = now;
        phase_ = Phase::Up;
        return news;
    }
    const bool first = !seen_;
    if (first || *closed != closed_) closed_since_ = now;
    closed_ = *closed;
    seen_ = true;
    if (first && closed_) from_start_ = true;

    if (closed_ != down_ && now - closed_since_ >= kDebounce) {
        down_ = closed_;
        if (down_) {
            down_since_ = closed_since_;
            told_ = false;
        } else {
            let_go(closed_since_ - down_since_, news);
        }
    }
    if (!closed_ && !down_) from_start_ = false;
    if (down_) press_goes_on((closed_ ? now : closed_since_) - down_since_, news);
    return news;
}

void Button::press_goes_on(Instant held, ButtonNews& news) {
    if (held > kStuck) {
        phase_ = Phase::Stuck;
    } else if (from_start_) {
        phase_ = held >= kFactory ? Phase::Factory : Phase::Down;
    } else if (held >= kShutdown) {
        phase_ = Phase::Shutdown;
    } else if (held >= kGuide) {
        phase_ = Phase::Guide;
        if (!told_) news.guide = told_ = true;
    } else {
        phase_ = Phase::Down;
    }
}

void Button::let_go(Instant held, ButtonNews& news) {
    phase_ = Phase::Up;
    if (held > kStuck) return;
    news.factory = from_start_ && held >= kFactory;
    news.click = !from_start_ && held >= kShortestClick && held <= kLongestClick;
    news.shutdown = !from_start_ && held >= kShutdown;
}

}  // namespace eddy
