#include "firmware/exhibit/heartbeats.h"

namespace eddy {

void Heartbeats::expect(Part part, Instant now) {
    beats_[static_cast<std::size_t>(part)] = Beat{.count = 0, .at = now};
}

void Heartbeats::give(Part part, Instant patience) {
    if (std::optional<Beat>& beat = beats_[static_cast<std::size_t>(part)]) beat->patience = patience;
}

void Heartbeats::see(Part part, std::uint64_t count, Instant now) {
    std::optional<Beat>& beat = beats_[static_cast<std::size_t>(part)];
    if (!beat || beat->count == count) return;
    beat->count = count;
    beat->at = now;
}

void Heartbeats::excuse(Instant now) {
    for (const Part part : {Part::Render, Part::Haptic, Part::Config})
        if (std::optional<Beat>& beat = beats_[static_cast<std::size_t>(part)]) beat->at = now;
}

std::optional<Part> Heartbeats::hanging(Instant now) const {
    for (std::size_t i = 0; i < beats_.size(); ++i)
        if (beats_[i] && now - beats_[i]->at > beats_[i]->patience) return static_cast<Part>(i);
    return std::nullopt;
}

bool Heartbeats::needs_restart(Instant now) const {
    const std::optional<Part> part = hanging(now);
    return part && *part < Part::Gpio;  // those before it are found first
}

}  // namespace eddy
