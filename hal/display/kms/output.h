#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hal/display/kms/card.h"
#include "hal/display/kms/monitor.h"

namespace eddy::kms {

/// One way from a buffer to a plug: plane, CRTC, connector, with the numbers of their properties looked up once. Each call
/// returns 0 or an errno. Never to be called while a flip is pending.
class Output {
  public:
    /// None if no CRTC can drive that plug; `why` says so.
    static std::optional<Output> find(Card& card, const Monitor& monitor, std::string& why);

    bool can_be_atomic() const { return can_be_atomic_; }
    bool atomic() const { return atomic_; }
    /// By atomic commits, if it can be, or by the older calls.
    void use_atomic(bool on) { atomic_ = on && can_be_atomic_; }
    std::uint32_t crtc() const { return crtc_; }
    /// What the plane takes in this format; empty: the driver names none.
    std::vector<std::uint64_t> modifiers(std::uint32_t format) const;
    bool takes(std::uint32_t format) const;

    /// Sets the mode and shows the buffer; an event follows. Atomic: asks first whether it would be possible.
    int set_mode(const drmModeModeInfo& mode, std::uint32_t framebuffer);
    /// The next buffer; an event follows.
    int flip(std::uint32_t framebuffer);
    /// The screen goes dark, and keeps its mode.
    int sleep();
    /// Nothing is driven any more.
    int off();

  private:
    explicit Output(Card& card) : card_(&card) {}

    std::vector<Setting> picture(std::uint32_t framebuffer, std::uint32_t width, std::uint32_t height) const;
    int set_mode_atomic(const drmModeModeInfo& mode, std::uint32_t framebuffer);

    Card* card_;
    std::uint32_t connector_ = 0, crtc_ = 0, plane_ = 0;
    bool can_be_atomic_ = false, atomic_ = false;
    struct {
        std::uint32_t crtc_id = 0, link_status = 0, dpms = 0;
    } of_connector_;
    struct {
        std::uint32_t active = 0, mode_id = 0;
    } of_crtc_;
    struct {
        std::uint32_t fb_id = 0, crtc_id = 0, src_x = 0, src_y = 0, src_w = 0, src_h = 0, crtc_x = 0,
                      crtc_y = 0, crtc_w = 0, crtc_h = 0;
    } of_plane_;
    std::vector<std::uint32_t> formats_;
    std::vector<FormatModifier> in_formats_;
};

}  // namespace eddy::kms
