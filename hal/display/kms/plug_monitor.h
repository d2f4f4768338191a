#pragma once
struct udev;
struct udev_monitor;

namespace eddy::kms {

/// Hears when the kernel says that a plug of a graphics card changed, or that a card came or went. Hears nothing where that is not
/// allowed (a sandbox without netlink): the display looks every ten seconds all the same.
class PlugMonitor {
  public:
    PlugMonitor();
    ~PlugMonitor();
    PlugMonitor(const PlugMonitor&) = delete;
    PlugMonitor& operator=(const PlugMonitor&) = delete;

    /// Since the last call; does not wait.
    bool changed();

  private:
    udev* udev_ = nullptr;
    udev_monitor* monitor_ = nullptr;
};

}  // namespace eddy::kms
