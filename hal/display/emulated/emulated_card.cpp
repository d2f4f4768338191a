#include "hal/display/emulated/emulated_card.h"

#include <drm_fourcc.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "hal/display/kms/monitor.h"

namespace eddy::emulated {
namespace {

using kms::Property;

/// The numbers of the properties; a kernel gives each its own.
enum Id : std::uint32_t {
    kCrtcId = 101,
    kEdid,
    kLinkStatus,
    kDpms,  // of connectors
    kActive,
    kModeId,  // of CRTCs
    kType,
    kFbId,
    kPlaneCrtcId,
    kSrcX,
    kSrcY,
    kSrcW,
    kSrcH,
    kCrtcX,
    kCrtcY,
    kCrtcW,
    kCrtcH,
    kInFormats,
};
constexpr std::uint32_t kFirstEdid = 201, kFormatsBlob = 301, kFirstFramebuffer = 401, kFirstModeBlob = 501;
constexpr std::uint64_t kTiled = fourcc_mod_code(INTEL, 1);
constexpr std::uint32_t kCrtcs = 2;

/// An open file of the card.
class OpenCard final : public kms::Card {
  public:
    OpenCard(std::shared_ptr<GraphicsCard> card, int fd) : c_(std::move(card)), fd_(fd) {
        ++c_->opened;
        if (c_->loses_flips_at_open && c_->opened > 1) c_->loses_flips_at_open = false;
        if (c_->master < 0 && c_->other_master.empty()) {
            c_->master = fd_;
            was_master_ = true;
        }
    }
    ~OpenCard() override {
        for (const std::uint32_t id : mine_) remove(id);
        if (c_->master == fd_) c_->master = -1;
    }
    OpenCard(const OpenCard&) = delete;
    OpenCard& operator=(const OpenCard&) = delete;

    std::string path() const override { return c_->path; }
    int fd() const override { return fd_; }
    bool is_master() const override { return c_->other_master.empty() && c_->master == fd_; }
    int take_master() override {
        if (!c_->other_master.empty()) return was_master_ ? EBUSY : EACCES;
        if (c_->master >= 0 && c_->master != fd_) return EBUSY;
        if (!was_master_) return EACCES;  // who never was needs to be root
        c_->master = fd_;
        return 0;
    }
    void drop_master() override {
        if (c_->master == fd_) c_->master = -1;
    }
    bool enable_atomic() override { return atomic_ = c_->has_atomic; }
    bool has_modifiers() const override { return c_->has_modifiers; }

    std::vector<kms::Connector> connectors(bool probe) override;
    std::vector<kms::Crtc> crtcs() override {
        std::vector<kms::Crtc> result;
        for (const auto& [id, state] : c_->crtcs)
            result.push_back({id, state.framebuffer, 0, 0, state.active ? state.mode : std::nullopt});
        return result;
    }
    std::vector<Property> crtc_properties(std::uint32_t crtc) override {
        return {{kActive, "ACTIVE", c_->crtcs.at(crtc).active}, {kModeId, "MODE_ID", 0}};
    }
    std::vector<kms::Plane> planes() override;
    std::vector<std::uint8_t> blob(std::uint32_t id) override {
        const std::size_t plug = id - kFirstEdid;
        return plug < c_->plugs.size() ? c_->plugs[plug].edid : std::vector<std::uint8_t>{};
    }
    std::vector<kms::FormatModifier> formats_in(std::uint32_t blob) override {
        if (blob != kFormatsBlob) return {};
        return {{DRM_FORMAT_XRGB8888, kTiled},
                {DRM_FORMAT_XRGB8888, DRM_FORMAT_MOD_LINEAR},
                {DRM_FORMAT_ARGB8888, DRM_FORMAT_MOD_LINEAR}};
    }

    int add_framebuffer(const kms::Buffer& buffer, std::uint32_t& id) override {
        if (buffer.modifier != DRM_FORMAT_MOD_INVALID && (c_->refuses_modifiers || !c_->has_modifiers))
            return EINVAL;
        id = kFirstFramebuffer;
        while (c_->framebuffers.contains(id)) ++id;
        c_->framebuffers[id] = buffer;
        mine_.insert(id);
        return 0;
    }
    void remove_framebuffer(std::uint32_t id) override {
        if (mine_.erase(id) > 0) remove(id);
    }
    int create_mode_blob(const drmModeModeInfo& mode, std::uint32_t& id) override {
        id = kFirstModeBlob;
        while (c_->mode_blobs.contains(id)) ++id;
        c_->mode_blobs[id] = mode;
        return 0;
    }
    void destroy_blob(std::uint32_t id) override { c_->mode_blobs.erase(id); }

    int commit(std::span<const kms::Setting> settings, std::uint32_t flags) override;
    int set_crtc(std::uint32_t crtc, std::uint32_t framebuffer, std::uint32_t x, std::uint32_t y,
                 std::span<const std::uint32_t> connectors, const drmModeModeInfo* mode) override;
    int page_flip(std::uint32_t crtc, std::uint32_t framebuffer) override;
    int set_connector_property(std::uint32_t connector, std::uint32_t property,
                               std::uint64_t value) override {
        if (!is_master()) return EACCES;
        if (property != kDpms || c_->cannot_sleep) return EINVAL;
        c_->plug_is_on.resize(c_->plugs.size(), true);
        c_->plug_is_on.at(connector - GraphicsCard::kFirstConnector) = value == DRM_MODE_DPMS_ON;
        return 0;
    }
    std::vector<kms::FlipEvent> events() override {
        std::vector<kms::FlipEvent> result;
        for (auto& [id, state] : c_->crtcs) {
            if (!state.flip_at || *state.flip_at > c_->now) continue;
            result.push_back({id, *state.flip_at, 0});
            state.flip_at.reset();
            ++c_->flips;
        }
        return result;
    }
    void wait(std::chrono::milliseconds at_most) override { c_->now += at_most; }
    Instant clock() const override { return c_->now; }

  private:
    using CrtcState = GraphicsCard::CrtcState;
    bool on_its_way(const CrtcState& state) const {
        return state.flip_at && (*state.flip_at == Instant::max() ? c_->hangs : *state.flip_at > c_->now);
    }
    bool loses() const {
        return c_->loses_flips || c_->loses_flips_at_reset || c_->loses_flips_at_open || c_->hangs;
    }
    /// When a picture that is sent now is seen.
    Instant lands(const CrtcState& state) const {
        if (loses()) return Instant::max();
        if (c_->flip_takes > Instant(0)) return c_->now + c_->flip_takes;
        const auto period = std::chrono::duration_cast<Instant>(Seconds(1.0 / kms::refresh_hz(*state.mode)));
        return (c_->now / period + 1) * period;
    }
    bool is_refused(const drmModeModeInfo& mode) const { return c_->refuses.contains(kms::describe(mode)); }
    void mode_was_set() {
        ++c_->modesets;
        c_->loses_flips_at_reset = false;
        for (Plug& plug : c_->plugs) plug.link_bad = false;
    }
    /// A picture that is shown and goes takes the screen with it.
    void remove(std::uint32_t id) {
        c_->framebuffers.erase(id);
        for (auto& [crtc, state] : c_->crtcs)
            if (state.framebuffer == id) {
                state.framebuffer = 0;
                state.active = false;
            }
    }

    std::shared_ptr<GraphicsCard> c_;
    int fd_;
    bool atomic_ = false, was_master_ = false;
    std::set<std::uint32_t> mine_;
};

std::vector<kms::Connector> OpenCard::connectors(bool probe) {
    if (probe) ++c_->probes;
    std::vector<kms::Connector> result;
    for (std::size_t i = 0; i < c_->plugs.size(); ++i) {
        const Plug& plug = c_->plugs[i];
        kms::Connector k;
        k.id = GraphicsCard::kFirstConnector + static_cast<std::uint32_t>(i);
        k.name = plug.name;
        k.connection = plug.connection;
        const bool there = plug.connection == kms::Connection::Connected;
        if (there) k.modes = plug.modes;
        for (const auto& [id, state] : c_->crtcs) {
            k.crtcs.push_back(id);
            if (state.plugs.contains(i)) k.crtc_now = id;
        }
        k.properties = {
            {kDpms, "DPMS", DRM_MODE_DPMS_ON},
            {kEdid, "EDID", there && !plug.edid.empty() ? kFirstEdid + static_cast<std::uint64_t>(i) : 0},
            {kLinkStatus, "link-status", plug.link_bad ? 1U : 0U}};
        if (atomic_) k.properties.push_back({kCrtcId, "CRTC_ID", k.crtc_now});
        result.push_back(std::move(k));
    }
    return result;
}

std::vector<kms::Plane> OpenCard::planes() {
    if (!atomic_) return {};
    std::vector<kms::Plane> result;
    std::uint32_t id = GraphicsCard::kFirstPlane;
    for (const auto& [crtc, state] : c_->crtcs) {
        kms::Plane p{id++, {crtc}, {DRM_FORMAT_XRGB8888, DRM_FORMAT_ARGB8888}, {}};
        p.properties = {
            {kType, "type", 1},    {kFbId, "FB_ID", 0},   {kPlaneCrtcId, "CRTC_ID", 0},
            {kSrcX, "SRC_X", 0},   {kSrcY, "SRC_Y", 0},   {kSrcW, "SRC_W", 0},
            {kSrcH, "SRC_H", 0},   {kCrtcX, "CRTC_X", 0}, {kCrtcY, "CRTC_Y", 0},
            {kCrtcW, "CRTC_W", 0}, {kCrtcH, "CRTC_H", 0}, {kInFormats, "IN_FORMATS", kFormatsBlob}};
        result.push_back(std::move(p));
    }
    return result;
}

int OpenCard::commit(std::span<const kms::Setting> settings, std::uint32_t flags) {
    if (!is_master()) return EACCES;
    if (!atomic_ || c_->refuses_atomic) return EINVAL;
    const bool test = (flags & DRM_MODE_ATOMIC_TEST_ONLY) != 0;
    if (test && (flags & DRM_MODE_PAGE_FLIP_EVENT) != 0) return EINVAL;
    // What it asks for, over what is.
    std::map<std::uint32_t, CrtcState> asked = c_->crtcs;
    std::set<std::uint32_t> touched;
    bool changes_mode = false;
    const auto crtc_of_plane = [&](std::uint32_t plane) {
        return GraphicsCard::kFirstCrtc + plane - GraphicsCard::kFirstPlane;
    };
    for (const kms::Setting& s : settings) {
        if (s.object >= GraphicsCard::kFirstConnector) {
            const std::size_t plug = s.object - GraphicsCard::kFirstConnector;
            if (s.property == kCrtcId)
                for (auto& [id, state] : asked) {
                    const bool was = state.plugs.contains(plug), is = id == s.value;
                    if (was != is) changes_mode = true, touched.insert(id);
                    if (is) state.plugs.insert(plug);
                    if (!is) state.plugs.erase(plug);
                }
            else if (s.property != kLinkStatus)
                return EINVAL;
            else if (c_->plugs[plug].link_bad && s.value == DRM_MODE_LINK_STATUS_GOOD)
                changes_mode = true;
        } else if (s.object >= GraphicsCard::kFirstPlane) {
            CrtcState& state = asked.at(crtc_of_plane(s.object));
            if (s.property == kFbId) {
                if (s.value != 0 && !c_->framebuffers.contains(static_cast<std::uint32_t>(s.value)))
                    return ENOENT;
                state.framebuffer = static_cast<std::uint32_t>(s.value);
                touched.insert(crtc_of_plane(s.object));
            }
        } else {
            CrtcState& state = asked.at(s.object);
            touched.insert(s.object);
            if (s.property == kActive) {
                changes_mode = changes_mode || state.active != (s.value != 0);
                state.active = s.value != 0;
            } else if (s.property == kModeId) {
                const auto blob = c_->mode_blobs.find(static_cast<std::uint32_t>(s.value));
                if (s.value != 0 && blob == c_->mode_blobs.end()) return EINVAL;
                changes_mode = true;
                state.mode = s.value != 0 ? std::optional(blob->second) : std::nullopt;
            } else {
                return EINVAL;
            }
        }
    }
    // Whether that can be.
    if (changes_mode && (flags & DRM_MODE_ATOMIC_ALLOW_MODESET) == 0) return EINVAL;
    for (const std::uint32_t id : touched) {
        const CrtcState& state = asked.at(id);
        if (state.active && (!state.mode || state.plugs.empty())) return EINVAL;
        if (state.mode && is_refused(*state.mode)) return EINVAL;
        if (c_->cannot_sleep && state.mode && !state.active) return EINVAL;
        if (c_->cannot_end && !state.mode) return EINVAL;
        if (!state.active && (flags & DRM_MODE_PAGE_FLIP_EVENT) != 0) return EINVAL;
        if (state.mode && state.framebuffer != 0) {
            const kms::Buffer& b = c_->framebuffers.at(state.framebuffer);
            if (b.width < state.mode->hdisplay || b.height < state.mode->vdisplay) return ENOSPC;
        }
    }
    if (test) {
        ++c_->tests;
        return 0;
    }
    for (const std::uint32_t id : touched)
        if (on_its_way(c_->crtcs.at(id))) {
            ++c_->commits_too_early;
            return EBUSY;
        }
    if (changes_mode) mode_was_set();
    for (const std::uint32_t id : touched) {
        CrtcState& state = asked.at(id);
        if ((flags & DRM_MODE_PAGE_FLIP_EVENT) != 0) state.flip_at = lands(state);
        c_->crtcs[id] = state;
    }
    return 0;
}

int OpenCard::set_crtc(std::uint32_t crtc, std::uint32_t framebuffer, std::uint32_t, std::uint32_t,
                       std::span<const std::uint32_t> connectors, const drmModeModeInfo* mode) {
    if (!is_master()) return EACCES;
    CrtcState& state = c_->crtcs.at(crtc);
    if (on_its_way(state)) ++c_->commits_too_early;
    if (!mode) {
        if (c_->cannot_end) return EINVAL;
        state = {};
        mode_was_set();
        return 0;
    }
    if (!c_->framebuffers.contains(framebuffer)) return ENOENT;
    if (is_refused(*mode)) return EINVAL;
    mode_was_set();
    state.mode = *mode;
    state.active = true;
    state.framebuffer = framebuffer;
    state.plugs.clear();
    state.flip_at.reset();
    for (const std::uint32_t id : connectors) state.plugs.insert(id - GraphicsCard::kFirstConnector);
    return 0;
}

int OpenCard::page_flip(std::uint32_t crtc, std::uint32_t framebuffer) {
    if (!is_master()) return EACCES;
    CrtcState& state = c_->crtcs.at(crtc);
    if (!state.active || !c_->framebuffers.contains(framebuffer)) return EINVAL;
    if (on_its_way(state)) {
        ++c_->commits_too_early;
        return EBUSY;
    }
    state.framebuffer = framebuffer;
    state.flip_at = lands(state);
    return 0;
}

}  // namespace

drmModeModeInfo make_mode(int width, int height, double hz, bool preferred) {
    drmModeModeInfo m{};
    m.hdisplay = static_cast<std::uint16_t>(width);
    m.vdisplay = static_cast<std::uint16_t>(height);
    m.hsync_start = static_cast<std::uint16_t>(width + 40);
    m.hsync_end = static_cast<std::uint16_t>(width + 80);
    m.htotal = static_cast<std::uint16_t>(width + 160);
    m.vsync_start = static_cast<std::uint16_t>(height + 3);
    m.vsync_end = static_cast<std::uint16_t>(height + 8);
    m.vtotal = static_cast<std::uint16_t>(height + 40);
    m.clock = static_cast<std::uint32_t>(std::lround(hz * m.htotal * m.vtotal / 1000.0));
    m.vrefresh = static_cast<std::uint32_t>(std::lround(hz));
    m.type = DRM_MODE_TYPE_DRIVER | (preferred ? DRM_MODE_TYPE_PREFERRED : 0U);
    const std::string name = fmt::format("{}x{}", width, height);
    std::copy(name.begin(), name.end(), m.name);
    return m;
}

std::vector<std::uint8_t> make_edid(const std::string& name) {
    std::vector<std::uint8_t> edid(128, 0);
    std::fill(edid.begin() + 1, edid.begin() + 7, std::uint8_t{0xff});
    edid[8] = 0x14;  // EDY, five bits a letter
    edid[9] = 0x99;
    edid[54 + 3] = 0xfc;
    std::fill(edid.begin() + 59, edid.begin() + 72, std::uint8_t{' '});
    std::copy_n(name.begin(), std::min<std::size_t>(name.size(), 13), edid.begin() + 59);
    if (name.size() < 13) edid[59 + name.size()] = '\n';
    return edid;
}

GraphicsCard::GraphicsCard(std::string path_) : path(std::move(path_)) {
    for (std::uint32_t i = 0; i < kCrtcs; ++i) crtcs[kFirstCrtc + i] = {};
}

std::unique_ptr<kms::Card> GraphicsCard::open(std::shared_ptr<GraphicsCard> self, int fd) {
    return std::make_unique<OpenCard>(std::move(self), fd);
}

std::uint32_t GraphicsCard::seen_on(std::size_t plug) const {
    if (plug < plug_is_on.size() && !plug_is_on[plug]) return 0;
    for (const auto& [id, state] : crtcs)
        if (state.plugs.contains(plug) && state.active) return state.framebuffer;
    return 0;
}

std::uint32_t GraphicsCard::show_console(std::size_t plug) {
    constexpr std::uint32_t kConsole = 9;
    const drmModeModeInfo mode = plugs[plug].modes.front();
    framebuffers[kConsole] = {
        mode.hdisplay, mode.vdisplay, DRM_FORMAT_XRGB8888, DRM_FORMAT_MOD_INVALID, 1, {}, {}, {}, -1};
    crtcs[kFirstCrtc] = {mode, true, kConsole, {plug}, std::nullopt};
    return kConsole;
}

}  // namespace eddy::emulated
