#pragma once
#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "hal/haptic/falcon/falcon.h"
#include "hal/haptic/falcon/usb_link.h"
#include "tests/hal/haptic/falcon/rig.h"
#include "tests/usb/bus.h"

namespace eddy {

/// The driver above the real libusb above an emulated Falcon on an emulated bus, all on virtual time: what Rig is
/// without USB between. The device outlives the driver.
struct UsbRig : DriverRig {
    explicit UsbRig(emulated::BoardSettings board = {}, FalconSettings driver_settings = {},
                    std::unique_ptr<emulated::HandMotion> motion = still(),
                    emulated::PlantSettings plant = {.hand = emulated::Hand::OnPath})
        : UsbRig(NoDevice{}) {
        settings = std::move(driver_settings);
        port = add(board, {}, std::move(motion), plant);
        start();
    }

    /// A bus without anything, and no driver yet.
    struct NoDevice {};
    explicit UsbRig(NoDevice) {
        bus().clear();
        now = bus().now();
    }
    ~UsbRig() override {
        driver.reset();
        bus().clear();
    }
    UsbRig(const UsbRig&) = delete;
    UsbRig& operator=(const UsbRig&) = delete;

    static usb::Bus& bus() { return usb::Bus::instance(); }
    static usb::Port* add(emulated::BoardSettings board = {}, emulated::UsbIdentity identity = {},
                          std::unique_ptr<emulated::HandMotion> motion = still(),
                          emulated::PlantSettings plant = {.hand = emulated::Hand::OnPath}) {
        return &bus().plug(std::make_unique<emulated::EmulatedFalcon>(std::move(motion), plant, board),
                           std::move(identity));
    }
    void start(const std::string& serial = {}) {
        driver = std::make_unique<Falcon>(std::make_unique<falcon::UsbLink>(serial), settings);
    }

    void advance() override {
        now = std::max(now, bus().now()) + std::chrono::milliseconds(1);  // waiting in libusb takes time, too
        const usb::InKernel kernel;
        bus().advance(now);
    }
    emulated::EmulatedFalcon& device() override { return port->device.falcon(); }

    FalconSettings settings;
    usb::Port* port = nullptr;
};

}  // namespace eddy
