#include "hal/display/kms/plug_monitor.h"

#include <libudev.h>

#include <string_view>

namespace eddy::kms {

PlugMonitor::PlugMonitor() {
    udev_ = udev_new();
    if (!udev_) return;
    // From the kernel itself: an exhibit may start before the device manager does.
    monitor_ = udev_monitor_new_from_netlink(udev_, "kernel");
    if (monitor_ && (udev_monitor_filter_add_match_subsystem_devtype(monitor_, "drm", nullptr) < 0 ||
                     udev_monitor_enable_receiving(monitor_) < 0)) {
        udev_monitor_unref(monitor_);
        monitor_ = nullptr;
    }
}

PlugMonitor::~PlugMonitor() {
    if (monitor_) udev_monitor_unref(monitor_);
    if (udev_) udev_unref(udev_);
}

bool PlugMonitor::changed() {
    bool any = false;
    while (udev_device* const device = monitor_ ? udev_monitor_receive_device(monitor_) : nullptr) {
        const char* action = udev_device_get_action(device);
        const char* hot_plug = udev_device_get_property_value(device, "HOTPLUG");
        any = any || (hot_plug && std::string_view(hot_plug) == "1") ||
              (action && std::string_view(action) != "change");
        udev_device_unref(device);
    }
    return any;
}

}  // namespace eddy::kms
