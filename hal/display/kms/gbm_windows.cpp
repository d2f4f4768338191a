#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <drm_fourcc.h>
#include <gbm.h>

#include <algorithm>
#include <map>

#include "hal/display/kms/drm_card.h"

namespace eddy::kms {
namespace {

Buffer describe(gbm_bo* bo, int fd, bool names_modifier) {
    Buffer b;
    b.width = gbm_bo_get_width(bo);
    b.height = gbm_bo_get_height(bo);
    b.format = gbm_bo_get_format(bo);
    b.modifier = names_modifier ? gbm_bo_get_modifier(bo) : DRM_FORMAT_MOD_INVALID;
    b.planes = std::min(gbm_bo_get_plane_count(bo), 4);
    for (int i = 0; i < b.planes; ++i) {
        b.handles[i] = gbm_bo_get_handle_for_plane(bo, i).u32;
        b.pitches[i] = gbm_bo_get_stride_for_plane(bo, i);
        b.offsets[i] = gbm_bo_get_offset(bo, i);
    }
    b.owner_fd = fd;
    return b;
}

class GbmWindow final : public Window {
  public:
    GbmWindow(gbm_surface* surface, int fd, bool names_modifier)
        : surface_(surface), fd_(fd), names_modifier_(names_modifier) {}
    ~GbmWindow() override { gbm_surface_destroy(surface_); }
    GbmWindow(const GbmWindow&) = delete;
    GbmWindow& operator=(const GbmWindow&) = delete;

    void* native() const override { return surface_; }
    const Buffer* lock_front() override {
        gbm_bo* const bo = gbm_surface_lock_front_buffer(surface_);
        if (!bo) return nullptr;
        const auto [at, is_new] = buffers_.try_emplace(bo);
        if (is_new) at->second = describe(bo, fd_, names_modifier_);
        bos_[&at->second] = bo;
        return &at->second;
    }
    void release(const Buffer* buffer) override { gbm_surface_release_buffer(surface_, bos_.at(buffer)); }
    bool has_free() const override { return gbm_surface_has_free_buffers(surface_) > 0; }

  private:
    gbm_surface* surface_;
    int fd_;
    bool names_modifier_;
    std::map<gbm_bo*, Buffer> buffers_;  // a surface keeps its few as long as it lives
    std::map<const Buffer*, gbm_bo*> bos_;
};

class GbmWindows final : public WindowMaker {
  public:
    GbmWindows(gbm_device* device, int fd) : device_(device), fd_(fd) {}
    ~GbmWindows() override { gbm_device_destroy(device_); }
    GbmWindows(const GbmWindows&) = delete;
    GbmWindows& operator=(const GbmWindows&) = delete;

    void* native() const override { return device_; }
    unsigned egl_platform() const override { return EGL_PLATFORM_GBM_KHR; }
    std::unique_ptr<Window> make(std::uint32_t width, std::uint32_t height, std::uint32_t format,
                                 Layout layout, std::span<const std::uint64_t> modifiers) override {
        constexpr std::uint32_t kUse = GBM_BO_USE_SCANOUT | GBM_BO_USE_RENDERING;
        gbm_surface* surface = nullptr;
        if (layout == Layout::Modifiers)
            surface = gbm_surface_create_with_modifiers(device_, width, height, format, modifiers.data(),
                                                        static_cast<unsigned>(modifiers.size()));
        else
            surface = gbm_surface_create(device_, width, height, format,
                                         layout == Layout::Linear ? kUse | GBM_BO_USE_LINEAR : kUse);
        if (!surface) return nullptr;
        return std::make_unique<GbmWindow>(surface, fd_, layout == Layout::Modifiers);
    }

  private:
    gbm_device* device_;
    int fd_;
};

}  // namespace

std::unique_ptr<WindowMaker> make_gbm_windows(Card& card) {
    gbm_device* const device = gbm_create_device(card.fd());
    if (!device) return nullptr;
    return std::make_unique<GbmWindows>(device, card.fd());
}

}  // namespace eddy::kms
