#pragma once
#include <string>

#include "firmware/exhibit/hand_side.h"
#include "gles/render/page.h"

namespace eddy {

/// What the line under the picture depends on.
struct CaptionInput {
    bool has_device = false;
    HapticState device = HapticState::Absent;
    GateReason force = GateReason::Open;
    bool seen_before = false;    ///< the device was ready since the start: it is missed now
    bool about_to_idle = false;  ///< the scene goes back to its start soon, for nobody is here
};

/// What somebody in front of the exhibit should know or do now, in one sentence; empty while all is well.
std::string caption(const CaptionInput& in);

/// Of this hand's side, as it was followed last.
std::string caption_of(const HandSide& hand, bool about_to_idle = false);

/// A sentence at the lower edge of a picture of this size, on a panel; on two lines if need be. Empty for an empty one.
gles::Page caption_page(const std::string& sentence, const glm::ivec2& picture_px);

}  // namespace eddy
