#pragma once
#include "hal/display/kms/card.h"

namespace eddy::kms {

/// A card of this machine, through libdrm.
Machine::Opened open_drm_card(const std::string& path);
/// Windows in its memory, through GBM; null if its driver has none.
std::unique_ptr<WindowMaker> make_gbm_windows(Card& card);

}  // namespace eddy::kms
