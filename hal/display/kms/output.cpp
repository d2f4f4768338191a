#include "hal/display/kms/output.h"

#include <drm_fourcc.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

namespace eddy::kms {
namespace {

constexpr std::uint64_t kPrimary = 1;  // of the property "type": DRM_PLANE_TYPE_PRIMARY

const Plane* primary_plane(const std::vector<Plane>& planes, std::uint32_t crtc) {
    for (const Plane& p : planes)
        if (property_value(p.properties, "type") == kPrimary &&
            std::find(p.crtcs.begin(), p.crtcs.end(), crtc) != p.crtcs.end())
            return &p;
    return nullptr;
}

}  // namespace

std::optional<Output> Output::find(Card& card, const Monitor& monitor, std::string& why) {
    Output out(card);
    out.connector_ = monitor.connector;

    // CRTC: the one that drives the plug already, else one that drives nothing, else the first that can.
    bool free = false;
    for (const Crtc& crtc : card.crtcs()) {
        if (std::find(monitor.crtcs.begin(), monitor.crtcs.end(), crtc.id) == monitor.crtcs.end()) continue;
        const bool better = out.crtc_ == 0 || (!free && !crtc.mode && out.crtc_ != monitor.crtc_now);
        if (!better && crtc.id != monitor.crtc_now) continue;
        out.crtc_ = crtc.id;
        free = !crtc.mode;
    }
    if (out.crtc_ == 0) {
        why = fmt::format("no CRTC of {} can drive {}", monitor.card, monitor.plug);
        return std::nullopt;
    }
    out.of_connector_ = {property_id(monitor.properties, "CRTC_ID"),
                         property_id(monitor.properties, "link-status"),
                         property_id(monitor.properties, "DPMS")};

    // Plane, and the numbers of all properties. Without one of them: the older calls, which need none.
    if (!card.enable_atomic()) return out;
    const std::vector<Plane> planes = card.planes();
    const Plane* const plane = primary_plane(planes, out.crtc_);
    if (!plane) return out;
    out.plane_ = plane->id;
    out.formats_ = plane->formats;
    const std::vector<Property> of_crtc = card.crtc_properties(out.crtc_);
    out.of_crtc_ = {property_id(of_crtc, "ACTIVE"), property_id(of_crtc, "MODE_ID")};
    const auto id = [plane](const char* name) { return property_id(plane->properties, name); };
    out.of_plane_ = {id("FB_ID"), id("CRTC_ID"), id("SRC_X"),  id("SRC_Y"),  id("SRC_W"),
                     id("SRC_H"), id("CRTC_X"),  id("CRTC_Y"), id("CRTC_W"), id("CRTC_H")};
    const auto& p = out.of_plane_;
    bool complete = out.of_connector_.crtc_id != 0 && out.of_crtc_.active != 0 && out.of_crtc_.mode_id != 0;
    for (const std::uint32_t needed :
         {p.fb_id, p.crtc_id, p.src_x, p.src_y, p.src_w, p.src_h, p.crtc_x, p.crtc_y, p.crtc_w, p.crtc_h})
        complete = complete && needed != 0;
    out.can_be_atomic_ = out.atomic_ = complete;
    if (const auto blob = property_value(plane->properties, "IN_FORMATS");
        blob && *blob != 0 && card.has_modifiers())
        out.in_formats_ = card.formats_in(static_cast<std::uint32_t>(*blob));
    return out;
}

std::vector<std::uint64_t> Output::modifiers(std::uint32_t format) const {
    std::vector<std::uint64_t> result;
    for (const FormatModifier& f : in_formats_)
        if (f.format == format) result.push_back(f.modifier);
    return result;
}

bool Output::takes(std::uint32_t format) const {
    return formats_.empty() || std::find(formats_.begin(), formats_.end(), format) != formats_.end();
}

std::vector<Setting> Output::picture(std::uint32_t framebuffer, std::uint32_t width,
                                     std::uint32_t height) const {
    const auto& p = of_plane_;
    const std::uint64_t w = width, h = height;
    return {{plane_, p.fb_id, framebuffer}, {plane_, p.crtc_id, crtc_}, {plane_, p.src_x, 0},
            {plane_, p.src_y, 0},           {plane_, p.src_w, w << 16}, {plane_, p.src_h, h << 16},
            {plane_, p.crtc_x, 0},          {plane_, p.crtc_y, 0},      {plane_, p.crtc_w, w},
            {plane_, p.crtc_h, h}};
}

int Output::set_mode(const drmModeModeInfo& mode, std::uint32_t framebuffer) {
    if (atomic_) return set_mode_atomic(mode, framebuffer);
    const std::uint32_t connectors[] = {connector_};
    if (const int error = card_->set_crtc(crtc_, framebuffer, 0, 0, connectors, &mode)) return error;
    if (of_connector_.dpms != 0)
        card_->set_connector_property(connector_, of_connector_.dpms, DRM_MODE_DPMS_ON);
    // The picture is on the screen; the event of a flip to the same one shows that flips work.
    return card_->page_flip(crtc_, framebuffer);
}

int Output::set_mode_atomic(const drmModeModeInfo& mode, std::uint32_t framebuffer) {
    std::uint32_t blob = 0;
    if (const int error = card_->create_mode_blob(mode, blob)) return error;
    std::vector<Setting> settings = picture(framebuffer, mode.hdisplay, mode.vdisplay);
    settings.insert(settings.end(), {{connector_, of_connector_.crtc_id, crtc_},
                                     {crtc_, of_crtc_.mode_id, blob},
                                     {crtc_, of_crtc_.active, 1}});
    if (of_connector_.link_status != 0)
        settings.push_back({connector_, of_connector_.link_status, DRM_MODE_LINK_STATUS_GOOD});
    int error = card_->commit(settings, DRM_MODE_ATOMIC_TEST_ONLY | DRM_MODE_ATOMIC_ALLOW_MODESET);
    constexpr std::uint32_t kDo = DRM_MODE_ATOMIC_ALLOW_MODESET | DRM_MODE_PAGE_FLIP_EVENT;
    if (error == 0) {
        error = card_->commit(settings, kDo | DRM_MODE_ATOMIC_NONBLOCK);
        if (error == EINVAL)
            error = card_->commit(settings, kDo);  // a driver that sets modes only while one waits
    }
    card_->destroy_blob(blob);  // the commit keeps its own
    return error;
}

int Output::flip(std::uint32_t framebuffer) {
    if (!atomic_) return card_->page_flip(crtc_, framebuffer);
    const Setting settings[] = {{plane_, of_plane_.fb_id, framebuffer}};
    return card_->commit(settings, DRM_MODE_ATOMIC_NONBLOCK | DRM_MODE_PAGE_FLIP_EVENT);
}

int Output::sleep() {
    if (atomic_) {
        const Setting settings[] = {{crtc_, of_crtc_.active, 0}};
        return card_->commit(settings, DRM_MODE_ATOMIC_ALLOW_MODESET);
    }
    if (of_connector_.dpms == 0) return ENOSYS;
    return card_->set_connector_property(connector_, of_connector_.dpms, DRM_MODE_DPMS_OFF);
}

int Output::off() {
    if (!atomic_) return card_->set_crtc(crtc_, 0, 0, 0, {}, nullptr);
    const Setting settings[] = {{connector_, of_connector_.crtc_id, 0},
                                {crtc_, of_crtc_.active, 0},
                                {crtc_, of_crtc_.mode_id, 0},
                                {plane_, of_plane_.fb_id, 0},
                                {plane_, of_plane_.crtc_id, 0}};
    return card_->commit(settings, DRM_MODE_ATOMIC_ALLOW_MODESET);
}

}  // namespace eddy::kms
