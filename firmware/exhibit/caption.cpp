#include "firmware/exhibit/caption.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware/exhibit/wrapped.h"

namespace eddy {
namespace {

// Lengths in ems, the size of the words: as large as those of the cost page (cost_page.cpp says why), and a half more.
constexpr double kEmsOfHeight = 20.0, kEmsOfWidth = 28.0;  // the picture
constexpr double kMargin = 0.6;
constexpr double kLine = 1.3;

}  // namespace

std::string caption(const CaptionInput& in) {
    if (in.force == GateReason::Stopped)
        return "The stop button was pressed: no force. Release it, then press the reset button.";
    if (in.has_device) switch (in.device) {
            case HapticState::Homing:
                return "Pull the handle all the way out, then push it all the way in.";
            case HapticState::Booting:
            case HapticState::Loading:
                return "The handle is waking up: one moment.";
            case HapticState::Fault:
                return "The handle does not work at the moment. You can watch the fluid.";
            case HapticState::Absent:
                return in.seen_before ? "The handle is not connected. You can watch the fluid." : "";
            case HapticState::Ready:
                break;
        }
    switch (in.force) {
        case GateReason::DeviceSilent:
        case GateReason::NotFinite:
            return "The handle rests for a moment, then its force comes back.";
        case GateReason::TooFast:
            return "Gently: at this speed the handle gives no force.";
        case GateReason::Released:
            return in.about_to_idle ? "Still there? Move the handle, or the fluid starts again."
                                    : "Take the handle and move it slowly.";
        default:
            break;
    }
    return in.about_to_idle ? "Still there? Move the handle, or the fluid starts again." : "";
}

std::string caption_of(const HandSide& hand, bool about_to_idle) {
    return caption({.has_device = hand.has_device(),
                    .device = hand.report().device,
                    .force = hand.report().reason,
                    .seen_before = hand.was_ready(),
                    .about_to_idle = about_to_idle});
}

gles::Page caption_page(const std::string& sentence, const glm::ivec2& picture_px) {
    gles::Page page;
    if (sentence.empty()) return page;
    const double em_px = std::min(picture_px.y / kEmsOfHeight, picture_px.x / kEmsOfWidth);
    const double most_ems = picture_px.x / em_px - 2.0 * kMargin - 1.0;
    const std::vector<std::string> lines = wrapped(sentence, most_ems);
    double widest = 0.0;
    const gles::Font font;
    for (const std::string& line : lines) widest = std::max(widest, font.width_px(line, 1.0));
    const double wide = widest + 2.0 * kMargin;
    const double high = 1.0 + kLine * (static_cast<double>(lines.size()) - 1.0) + kMargin;
    page.size_px = glm::ivec2(glm::ceil(em_px * glm::dvec2(wide, high)));
    page.corner_px = {(picture_px.x - page.size_px.x) / 2,
                      picture_px.y - page.size_px.y - static_cast<int>(std::round(kMargin * em_px))};
    page.boxes.push_back(gles::panel(glm::dvec2(0.0), glm::dvec2(page.size_px)));
    for (std::size_t n = 0; n < lines.size(); ++n)
        page.lines.push_back(
            {.text = lines[n],
             .at_px = em_px * glm::dvec2(0.5 * wide, 0.5 * kMargin + 0.8 + kLine * static_cast<double>(n)),
             .size_px = em_px,
             .align = gles::Align::Centre});
    return page;
}

}  // namespace eddy
