#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hal/display/kms/card.h"

namespace eddy::kms {

/// A plug of a card and what hangs on it.
struct Monitor {
    std::string card;  ///< "card0"
    std::uint32_t connector = 0;
    std::string plug;  ///< "HDMI-A-1"
    Connection connection = Connection::Unknown;
    std::vector<drmModeModeInfo> modes;
    std::vector<std::uint32_t> crtcs;  ///< that can drive it
    std::uint32_t crtc_now = 0;        ///< that does
    std::string name;                  ///< what it calls itself; empty: no EDID
    std::string id;                    ///< of its EDID; empty: none
    bool link_bad = false;
    std::vector<Property> properties;
};

/// All plugs of a card.
std::vector<Monitor> look_for_monitors(Card& card, bool probe);

/// The number of the property of that name; 0 if there is none.
std::uint32_t property_id(const std::vector<Property>& properties, std::string_view name);
std::optional<std::uint64_t> property_value(const std::vector<Property>& properties, std::string_view name);

/// Refreshes a second, from the timings.
double refresh_hz(const drmModeModeInfo& mode);
/// "1920x1080@60", or "1920x1080@59.94".
std::string describe(const drmModeModeInfo& mode);
bool same_mode(const drmModeModeInfo& a, const drmModeModeInfo& b);
/// Whether plug, monitor, link and modes are as they were.
bool same_monitor(const Monitor& a, const Monitor& b);

}  // namespace eddy::kms
