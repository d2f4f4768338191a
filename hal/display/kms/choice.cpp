#include "hal/display/kms/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace eddy::kms {
namespace {

/// Of an exhibit that nobody said otherwise for.
constexpr double kUsualHz = 60.0;
/// 59.94 is 60 to whoever writes it; 50 and 75 are not.
constexpr double kSameHz = 0.5;

drmModeModeInfo timings(std::uint32_t clock_khz, std::uint16_t width, std::uint16_t h_start,
                        std::uint16_t h_end, std::uint16_t h_total, std::uint16_t height,
                        std::uint16_t v_start, std::uint16_t v_end, std::uint16_t v_total,
                        std::uint32_t flags) {
    drmModeModeInfo m{};
    m.clock = clock_khz;
    m.hdisplay = width;
    m.hsync_start = h_start;
    m.hsync_end = h_end;
    m.htotal = h_total;
    m.vdisplay = height;
    m.vsync_start = v_start;
    m.vsync_end = v_end;
    m.vtotal = v_total;
    m.vrefresh = 60;
    m.flags = flags;
    m.type = DRM_MODE_TYPE_USERDEF;
    const std::string name = fmt::format("{}x{}", width, height);
    std::copy(name.begin(), name.end(), m.name);
    return m;
}

/// What nearly every screen takes, best first: CEA-861 video codes 16, 4 and 1.
const std::vector<drmModeModeInfo>& usual_modes() {
    constexpr std::uint32_t kPositive = DRM_MODE_FLAG_PHSYNC | DRM_MODE_FLAG_PVSYNC;
    constexpr std::uint32_t kNegative = DRM_MODE_FLAG_NHSYNC | DRM_MODE_FLAG_NVSYNC;
    static const std::vector<drmModeModeInfo> modes{
        timings(148500, 1920, 2008, 2052, 2200, 1080, 1084, 1089, 1125, kPositive),
        timings(74250, 1280, 1390, 1430, 1650, 720, 725, 730, 750, kPositive),
        timings(25175, 640, 656, 752, 800, 480, 490, 492, 525, kNegative),
    };
    return modes;
}

bool interlaced(const drmModeModeInfo& mode) {
    return (mode.flags & DRM_MODE_FLAG_INTERLACE) != 0;
}

/// Of that size, at the rate nearest to `hz`; whole pictures before halves of them.
const drmModeModeInfo* nearest(const std::vector<drmModeModeInfo>& modes, int width, int height, double hz) {
    const drmModeModeInfo* best = nullptr;
    for (const drmModeModeInfo& m : modes) {
        if (m.hdisplay != width || m.vdisplay != height) continue;
        const auto rank = [hz](const drmModeModeInfo& mode) {
            return std::pair(interlaced(mode), std::abs(refresh_hz(mode) - hz));
        };
        if (!best || rank(m) < rank(*best)) best = &m;
    }
    return best;
}

bool can_show(const Monitor& m) {
    return m.connection == Connection::Connected && !m.modes.empty();
}

}  // namespace

std::optional<WrittenMode> parse_mode(std::string_view text) {
    WrittenMode mode;
    const char* at = text.data();
    const char* const end = at + text.size();
    const auto number = [&](auto& value) {
        const auto [next, error] = std::from_chars(at, end, value);
        at = next;
        return error == std::errc() && value > 0;
    };
    const auto letter = [&](char c) { return at != end && *at++ == c; };
    if (!number(mode.width) || !letter('x') || !number(mode.height)) return std::nullopt;
    if (at == end) return mode;
    double hz = 0.0;
    if (!letter('@') || !number(hz) || at != end || !std::isfinite(hz)) return std::nullopt;
    mode.hz = hz;
    return mode;
}

bool is_named(const Monitor& monitor, const std::string& connector) {
    return monitor.plug == connector || monitor.card + "-" + monitor.plug == connector;
}

std::optional<ChosenMonitor> choose_monitor(std::span<const Monitor> monitors, const Wish& wish) {
    if (!wish.connector.empty()) {
        // Two cards may each have an HDMI-A-1.
        for (const Connection enough : {Connection::Connected, Connection::Unknown})
            for (std::size_t i = 0; i < monitors.size(); ++i)
                if (is_named(monitors[i], wish.connector) && monitors[i].connection == enough)
                    return ChosenMonitor{i, enough == Connection::Connected
                                                ? "screen.connector names it"
                                                : "screen.connector names it; the card cannot tell whether "
                                                  "anything is connected"};
        return std::nullopt;
    }
    std::optional<ChosenMonitor> first;
    for (std::size_t i = 0; i < monitors.size(); ++i) {
        if (!can_show(monitors[i])) continue;
        if (!wish.last_used.empty() && monitors[i].id == wish.last_used)
            return ChosenMonitor{i, "the screen of last time"};
        if (!first) first = ChosenMonitor{i, "the first that is connected"};
    }
    return first;
}

std::vector<ChosenMode> choose_modes(const Monitor& monitor, const Wish& wish) {
    std::vector<ChosenMode> chosen;
    const auto add = [&chosen](const drmModeModeInfo* mode, std::string why) {
        if (!mode) return;
        for (const ChosenMode& c : chosen)
            if (same_mode(c.mode, *mode)) return;
        chosen.push_back({*mode, std::move(why)});
    };
    const std::vector<drmModeModeInfo>& modes = monitor.modes.empty() ? usual_modes() : monitor.modes;
    if (const auto wished = parse_mode(wish.mode)) {
        const drmModeModeInfo* mode =
            nearest(modes, wished->width, wished->height, wished->hz.value_or(kUsualHz));
        const bool exact = mode && wished->hz && std::abs(refresh_hz(*mode) - *wished->hz) < kSameHz;
        add(mode, exact        ? "screen.mode asks for it"
                  : wished->hz ? "of the size that screen.mode asks for, at the nearest rate there is"
                               : "of the size that screen.mode asks for");
    }
    const char* const instead =
        wish.mode.empty() || !chosen.empty() ? "" : "; there is none of the size that screen.mode asks for";
    for (const drmModeModeInfo& m : monitor.modes)
        if ((m.type & DRM_MODE_TYPE_PREFERRED) != 0)
            add(&m, fmt::format("the monitor prefers it{}", instead));
    for (const drmModeModeInfo& usual : usual_modes())
        add(nearest(modes, usual.hdisplay, usual.vdisplay, kUsualHz),
            monitor.modes.empty() ? "a usual mode; the monitor names none"
                                  : fmt::format("a usual mode{}", instead));
    if (!modes.empty()) add(&modes.front(), fmt::format("the first that the monitor names{}", instead));
    return chosen;
}

}  // namespace eddy::kms
