#pragma once
#include <glm/glm.hpp>
#include <memory>
#include <string>

namespace eddy {

/// Where pictures go. Hands out what EGL needs (the arguments of eglGetPlatformDisplay and
/// eglCreatePlatformWindowSurface), so that whoever draws needs to know nothing of screens.
class Display {
  public:
    virtual ~Display() = default;
    virtual unsigned egl_platform() const = 0;
    virtual void* native_display() const = 0;
    virtual void* native_window() const = 0;  ///< null: there is no screen, draw into textures
    /// Puts the buffer that eglSwapBuffers just finished on the screen. GL thread; once per frame, after the
    /// swap.
    virtual void present() = 0;
    virtual std::string describe() const = 0;  ///< for the log
};

/// No screen: the GPU of an EGL device if the machine has one, else the software rasteriser.
std::unique_ptr<Display> make_headless_display();
/// No screen and no GPU: Mesa's surfaceless platform, which every machine with Mesa has.
std::unique_ptr<Display> make_software_display();

}  // namespace eddy
