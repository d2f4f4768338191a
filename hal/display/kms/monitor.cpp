#include "hal/display/kms/monitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "hal/display/kms/edid.h"

namespace eddy::kms {

std::vector<Monitor> look_for_monitors(Card& card, bool probe) {
    const std::string path = card.path();
    std::vector<Monitor> monitors;
    for (Connector& connector : card.connectors(probe)) {
        Monitor m;
        m.card = path.substr(path.rfind('/') + 1);
        m.connector = connector.id;
        m.plug = std::move(connector.name);
        m.connection = connector.connection;
        m.modes = std::move(connector.modes);
        m.crtcs = std::move(connector.crtcs);
        m.crtc_now = connector.crtc_now;
        m.properties = std::move(connector.properties);
        if (const auto blob = property_value(m.properties, "EDID"); blob && *blob != 0) {
            const std::vector<std::uint8_t> edid = card.blob(static_cast<std::uint32_t>(*blob));
            m.name = monitor_name(edid);
            m.id = monitor_id(edid);
        }
        m.link_bad = property_value(m.properties, "link-status").value_or(DRM_MODE_LINK_STATUS_GOOD) ==
                     DRM_MODE_LINK_STATUS_BAD;
        monitors.push_back(std::move(m));
    }
    return monitors;
}

std::uint32_t property_id(const std::vector<Property>& properties, std::string_view name) {
    for (const Property& p : properties)
        if (p.name == name) return p.id;
    return 0;
}

std::optional<std::uint64_t> property_value(const std::vector<Property>& properties, std::string_view name) {
    for (const Property& p : properties)
        if (p.name == name) return p.value;
    return std::nullopt;
}

double refresh_hz(const drmModeModeInfo& mode) {
    if (mode.htotal == 0 || mode.vtotal == 0) return mode.vrefresh;
    double hz = mode.clock * 1000.0 / (static_cast<double>(mode.htotal) * mode.vtotal);
    if ((mode.flags & DRM_MODE_FLAG_INTERLACE) != 0) hz *= 2.0;
    if ((mode.flags & DRM_MODE_FLAG_DBLSCAN) != 0) hz /= 2.0;
    if (mode.vscan > 1) hz /= mode.vscan;
    return hz;
}

std::string describe(const drmModeModeInfo& mode) {
    const double hz = std::round(refresh_hz(mode) * 100.0) / 100.0;
    return fmt::format("{}x{}@{:g}{}", mode.hdisplay, mode.vdisplay, hz,
                       (mode.flags & DRM_MODE_FLAG_INTERLACE) != 0 ? " interlaced" : "");
}

bool same_mode(const drmModeModeInfo& a, const drmModeModeInfo& b) {
    return a.hdisplay == b.hdisplay && a.vdisplay == b.vdisplay && a.clock == b.clock &&
           a.htotal == b.htotal && a.vtotal == b.vtotal && a.flags == b.flags;
}

bool same_monitor(const Monitor& a, const Monitor& b) {
    return a.connector == b.connector && a.connection == b.connection && a.id == b.id &&
           a.link_bad == b.link_bad &&
           std::equal(a.modes.begin(), a.modes.end(), b.modes.begin(), b.modes.end(), same_mode);
}

}  // namespace eddy::kms
