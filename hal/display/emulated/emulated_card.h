#pragma once
#include <xf86drmMode.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hal/display/kms/card.h"

namespace eddy::emulated {

/// Timings of that size and rate that add up; the first of a plug is what its monitor prefers.
drmModeModeInfo make_mode(int width, int height, double hz, bool preferred = false);
/// The 128 bytes with which a monitor of that name answers.
std::vector<std::uint8_t> make_edid(const std::string& name);

/// A plug of an emulated card, to be changed while it runs.
struct Plug {
    std::string name = "HDMI-A-1";
    kms::Connection connection = kms::Connection::Connected;
    std::vector<drmModeModeInfo> modes{make_mode(1920, 1080, 60.0, true), make_mode(1920, 1080, 50.0),
                                       make_mode(1280, 720, 60.0), make_mode(640, 480, 60.0)};
    std::vector<std::uint8_t> edid = make_edid("Hall 1");
    bool link_bad = false;
};

/// A graphics card and the kernel's driver for it: plugs, two CRTCs, a primary plane each. Keeps the rules of kernel mode setting
/// (who is master, what an atomic commit must name, that a flip is on its way), and breaks them when told to.
class GraphicsCard {
  public:
    explicit GraphicsCard(std::string path);

    std::string path;
    std::vector<Plug> plugs{Plug{}};

    // What goes wrong.
    int open_error = 0;
    bool has_atomic = true, has_modifiers = true;
    bool refuses_atomic = false;     ///< every atomic commit, though it has them
    bool refuses_modifiers = false;  ///< framebuffers that name one
    std::set<std::string> refuses;   ///< modes, as "1920x1080@60"
    bool cannot_sleep = false;       ///< a screen with a mode stays lit
    bool cannot_end = false;         ///< nor can its mode be taken away
    bool loses_flips = false;        ///< they happen, but nobody is told
    bool hangs = false;              ///< they never happen, and nothing else does while they are waited for
    bool loses_flips_at_reset = false;  ///< only until a mode is set again
    bool loses_flips_at_open = false;   ///< only until the card is opened again
    Instant flip_takes{0};              ///< not 0: so long, whatever the refresh, as on virtio-gpu
    bool makes_windows = true;
    std::set<kms::Layout> no_layouts;    ///< that windows cannot have
    std::set<std::uint32_t> no_formats;  ///< that windows cannot have
    std::string other_master;  ///< a program that drives the screen; opening does not make us master
    int buffers = 4;           ///< of a window

    // What is so now.
    struct CrtcState {
        std::optional<drmModeModeInfo> mode;
        bool active = false;
        std::uint32_t framebuffer = 0;
        std::set<std::size_t> plugs;
        std::optional<Instant> flip_at;  ///< on its way; Instant::max(): never comes
    };
    std::map<std::uint32_t, CrtcState> crtcs;
    std::map<std::uint32_t, kms::Buffer> framebuffers;
    std::map<std::uint32_t, drmModeModeInfo> mode_blobs;
    std::vector<bool> plug_is_on;  ///< DPMS of the older calls
    int master = -1;               ///< whose file number; -1: nobody
    Instant now{0};

    // What was done to it.
    int modesets = 0, flips = 0, opened = 0, probes = 0;
    int commits_too_early = 0;  ///< while a flip was on its way
    int tests = 0;              ///< of whether a commit would be possible

    std::unique_ptr<kms::Card> open(std::shared_ptr<GraphicsCard> self, int fd);
    /// Which picture is seen on that plug; 0: it is dark.
    std::uint32_t seen_on(std::size_t plug) const;
    /// As a console leaves it: a picture of the kernel's own on this plug.
    std::uint32_t show_console(std::size_t plug);
    static constexpr std::uint32_t kFirstCrtc = 31, kFirstPlane = 41, kFirstConnector = 51;
};

}  // namespace eddy::emulated
