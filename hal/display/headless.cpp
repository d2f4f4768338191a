#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string_view>
#include <vector>

#include "hal/display/display.h"

namespace eddy {
namespace {

bool has_extension(const char* list, std::string_view name) {
    if (!list) return false;
    const std::string_view all(list);
    for (std::size_t at = all.find(name); at != all.npos; at = all.find(name, at + 1)) {
        const bool starts = at == 0 || all[at - 1] == ' ';
        const std::size_t end = at + name.size();
        if (starts && (end == all.size() || all[end] == ' ')) return true;
    }
    return false;
}

/// The first EGL device that is a piece of hardware; null if there is none.
EGLDeviceEXT find_hardware() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_EXT_platform_device")) return nullptr;
    // eglGetProcAddress returns a function of unknown type; the cast is what EGL asks for.
    const auto query_devices =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto query_string =
        reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
    if (!query_devices || !query_string) return nullptr;
    EGLint count = 0;
    query_devices(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    query_devices(count, devices.data(), &count);
    for (EGLDeviceEXT device : devices)
        if (!has_extension(query_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) return device;
    return nullptr;
}

class HeadlessDisplay final : public Display {
  public:
    explicit HeadlessDisplay(EGLDeviceEXT device) : device_(device) {}
    unsigned egl_platform() const override {
        return device_ ? EGL_PLATFORM_DEVICE_EXT : EGL_PLATFORM_SURFACELESS_MESA;
    }
    void* native_display() const override { return device_; }
    void* native_window() const override { return nullptr; }
    std::optional<SizePx> size_px() const override { return std::nullopt; }
    long window_number() const override { return 0; }
    void refuse_window() override {}
    DisplayState poll(Instant) override { return awake_ ? DisplayState::NoMonitor : DisplayState::Asleep; }
    bool wants_frame() const override { return false; }
    void present() override {}
    void set_awake(bool awake) override { awake_ = awake; }
    DisplayCounters counters() const override { return {}; }
    std::string problem() const override { return ""; }
    std::string screen_id() const override { return ""; }
    std::string describe() const override {
        return device_ ? "no screen; GPU through EGL_EXT_platform_device"
                       : "no screen; EGL_MESA_platform_surfaceless";
    }

  private:
    EGLDeviceEXT device_;
    bool awake_ = true;
};

}  // namespace

std::unique_ptr<Display> make_headless_display() {
    return std::make_unique<HeadlessDisplay>(find_hardware());
}
std::unique_ptr<Display> make_software_display() {
    return std::make_unique<HeadlessDisplay>(nullptr);
}

}  // namespace eddy
