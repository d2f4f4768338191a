#include "firmware/quality/preset_choice.h"

namespace eddy {
namespace {

constexpr std::uint8_t kRight = 1, kLeft = 8;  // bits of HandleReading::buttons

}  // namespace

PresetChoice::PresetChoice(std::vector<SolverPreset> presets, Seconds every)
    : presets_(std::move(presets)), every_(every) {}

std::optional<SolverPreset> PresetChoice::look(Instant now, std::uint8_t buttons) {
    const auto fresh = static_cast<std::uint8_t>(buttons & ~pressed_);
    pressed_ = buttons;
    if (presets_.size() < 2) return std::nullopt;
    const bool by_itself = every_ > Seconds(0.0) && now - since_ >= every_;
    const std::size_t n = presets_.size();
    if (fresh & kRight || by_itself)
        shown_ = (shown_ + 1) % n;
    else if (fresh & kLeft)
        shown_ = (shown_ + n - 1) % n;
    else
        return std::nullopt;
    since_ = now;
    return presets_[shown_];
}

}  // namespace eddy
