#include "hal/gpio/kept_line.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "hal/gpio/find_line.h"

namespace eddy {

KeptLine::KeptLine(Gpio& gpio, std::string address, const GpioWish& wish)
    : gpio_(gpio), address_(std::move(address)), wish_(wish) {}

std::optional<bool> KeptLine::read(Instant now) {
    if (!is_there(now)) return std::nullopt;
    try {
        // First: an edge that comes between the two is seen at the next call.
        const bool rose = line_->take_edges(), late = now - read_at_ > kLate;
        read_at_ = now;
        return line_->active() || (late && rose);
    } catch (const std::system_error& e) {
        lose(now, e.what());
        return std::nullopt;
    }
}

void KeptLine::write(Instant now, bool active) {
    if (!is_there(now)) return;
    if (written_ == active && now - written_at_ < kSayAgain) return;
    try {
        line_->set(active);
        written_ = active;
        written_at_ = now;
    } catch (const std::system_error& e) {
        lose(now, e.what());
    }
}

bool KeptLine::is_there(Instant now) {
    if (line_) return true;
    if (!wanted() || (tried_at_ && now - *tried_at_ < kRetry)) return false;
    tried_at_ = now;
    try {
        line_ = open_line(gpio_, address_, wish_);
        trouble_.clear();
    } catch (const GpioError& e) {
        trouble_ = e.what();
    }
    return line_ != nullptr;
}

void KeptLine::lose(Instant now, const char* why) {
    line_.reset();
    written_.reset();
    tried_at_ = now;
    trouble_ = fmt::format("GPIO line '{}' went away ({}): is its USB bridge plugged in?", address_, why);
}

}  // namespace eddy
