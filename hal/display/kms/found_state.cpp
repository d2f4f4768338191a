#include "hal/display/kms/found_state.h"

namespace eddy::kms {

FoundState::FoundState(Card& card) : crtcs_(card.crtcs()) {
    for (const Connector& c : card.connectors(false))
        if (c.crtc_now != 0) connectors_[c.crtc_now].push_back(c.id);
}

void FoundState::put_back(Card& card, const std::set<std::uint32_t>& crtcs) const {
    // The older calls do it in one go on every driver.
    for (const Crtc& found : crtcs_) {
        if (!crtcs.contains(found.id)) continue;
        const auto drove = connectors_.find(found.id);
        if (found.mode && found.framebuffer != 0 && drove != connectors_.end() &&
            card.set_crtc(found.id, found.framebuffer, found.x, found.y, drove->second, &*found.mode) == 0)
            continue;
        card.set_crtc(found.id, 0, 0, 0, {}, nullptr);
    }
}

}  // namespace eddy::kms
