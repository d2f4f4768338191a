#include "firmware/stability/stepped_exhibit.h"

#include <algorithm>

namespace eddy::stability {

SteppedExhibit::SteppedExhibit(gles::Gpu& gpu, const Scene& scene, HapticDevice* hand,
                               const ForceFilterSettings& filter)
    : show_(gpu, scene, exchange_), orders_(orders_for(scene, show_.fluid().setup())) {
    order(orders_);
    if (!hand) return;
    HapticLoopSettings settings{.filter = filter};
    settings.gate.max_force_n = std::min(settings.gate.max_force_n, scene.haptics.max_force_n);
    loop_.emplace(*hand, exchange_, trace_, settings);
}

void SteppedExhibit::tick(Instant now) {
    if (loop_) loop_->tick(now);
}

void SteppedExhibit::update(Instant now, Seconds dt) {
    if (show_.figures().steps > 0) show_.publish(true);
    show_.update(now, dt, false);
}

const std::vector<TickRecord>& SteppedExhibit::ticks() {
    ticks_.resize(1000);
    std::size_t count = 0;
    while (const std::size_t more = trace_.drain(std::span(ticks_).subspan(count))) {
        count += more;
        if (count == ticks_.size()) ticks_.resize(2 * count);
    }
    ticks_.resize(count);
    return ticks_;
}

}  // namespace eddy::stability
