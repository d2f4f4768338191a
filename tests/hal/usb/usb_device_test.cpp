#include "hal/haptic/emulated/usb_device.h"

#include <gtest/gtest.h>
#include <libusb.h>

#include <array>
#include <string>
#include <vector>

#include "tests/hal/usb/usb_rig.h"

// The emulated device as any program sees it: libusb's ordinary calls, without the driver. Time goes on while they wait.

namespace eddy {
namespace {

class UsbDevice : public testing::Test {
  protected:
    void SetUp() override {
        UsbRig::bus().clear();
        port_ = UsbRig::add(cold(), {.serial = "FTPNM0FB"});
        ASSERT_EQ(libusb_init(&context_), LIBUSB_SUCCESS);
        handle_ = libusb_open_device_with_vid_pid(context_, 0x0403, 0xCB48);
        ASSERT_NE(handle_, nullptr);
    }
    void TearDown() override {
        if (handle_) libusb_close(handle_);
        libusb_exit(context_);
        UsbRig::bus().clear();
    }
    std::string string(std::uint8_t index) {
        std::array<unsigned char, 64> text{};
        const int size = libusb_get_string_descriptor_ascii(handle_, index, text.data(), text.size());
        return {text.begin(), text.begin() + std::max(size, 0)};
    }
    /// What the device answers to a vendor request, or libusb's error.
    std::pair<int, std::vector<std::uint8_t>> ask(std::uint8_t request, std::uint16_t length) {
        std::vector<std::uint8_t> answer(length);
        const int size = libusb_control_transfer(handle_, 0xC0, request, 0, 0, answer.data(), length, 1000);
        return {size, answer};
    }
    int tell(std::uint8_t request, std::uint16_t value) {
        return libusb_control_transfer(handle_, 0x40, request, value, 0, nullptr, 0, 1000);
    }

    usb::Port* port_ = nullptr;
    libusb_context* context_ = nullptr;
    libusb_device_handle* handle_ = nullptr;
};

TEST_F(UsbDevice, SaysWhatItIs) {
    libusb_device_descriptor device{};
    ASSERT_EQ(libusb_get_device_descriptor(libusb_get_device(handle_), &device), LIBUSB_SUCCESS);
    EXPECT_EQ(device.bcdUSB, 0x0200);
    EXPECT_EQ(device.bcdDevice, 0x0600);
    EXPECT_EQ(libusb_get_device_speed(libusb_get_device(handle_)), LIBUSB_SPEED_FULL);
    EXPECT_EQ(string(device.iManufacturer), "FTDI");
    EXPECT_EQ(string(device.iProduct), "FALCON HAPTIC");
    EXPECT_EQ(string(device.iSerialNumber), "FTPNM0FB");
}

TEST_F(UsbDevice, HasTwoBulkEndpointsOfSixtyFourBytes) {
    libusb_config_descriptor* config = nullptr;
    ASSERT_EQ(libusb_get_active_config_descriptor(libusb_get_device(handle_), &config), LIBUSB_SUCCESS);
    ASSERT_EQ(config->bNumInterfaces, 1);
    const libusb_interface_descriptor& interface = config->interface[0].altsetting[0];
    ASSERT_EQ(interface.bNumEndpoints, 2);
    EXPECT_EQ(interface.endpoint[0].bEndpointAddress, 0x81);
    EXPECT_EQ(interface.endpoint[1].bEndpointAddress, 0x02);
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(interface.endpoint[i].bmAttributes, LIBUSB_TRANSFER_TYPE_BULK);
        EXPECT_EQ(interface.endpoint[i].wMaxPacketSize, 64);
    }
    libusb_free_config_descriptor(config);
}

TEST_F(UsbDevice, AnswersTheChipsOwnRequestsAndRefusesOthers) {
    EXPECT_EQ(ask(0x0A, 1), std::pair(1, std::vector<std::uint8_t>{16})) << "latency after power on";
    EXPECT_EQ(tell(0x09, 1), 0);
    EXPECT_EQ(ask(0x0A, 1), std::pair(1, std::vector<std::uint8_t>{1}));
    EXPECT_EQ(ask(0x05, 2), std::pair(2, (std::vector<std::uint8_t>{0x01, 0x60}))) << "modem status";
    EXPECT_EQ(ask(0x77, 2).first, LIBUSB_ERROR_PIPE);
    EXPECT_EQ(tell(0x77, 0), LIBUSB_ERROR_PIPE);
}

TEST_F(UsbDevice, SendsItsStatusWhenItHasNothingElse) {
    ASSERT_EQ(libusb_claim_interface(handle_, 0), LIBUSB_SUCCESS);
    std::array<unsigned char, 512> buffer{};
    int size = 0;
    const Instant before = UsbRig::bus().now();
    ASSERT_EQ(libusb_bulk_transfer(handle_, 0x81, buffer.data(), buffer.size(), &size, 1000), LIBUSB_SUCCESS);
    EXPECT_EQ(size, 2);
    EXPECT_EQ(buffer[0], 0x01);
    EXPECT_EQ(buffer[1], 0x60);
    EXPECT_LE(UsbRig::bus().now() - before, std::chrono::milliseconds(17)) << "the latency timer";
}

// libnifalcon reads with buffers of 3 and 18 bytes and meets this (its pull request 30).
TEST_F(UsbDevice, OverflowsABufferThatIsTooSmallForAPacket) {
    ASSERT_EQ(libusb_claim_interface(handle_, 0), LIBUSB_SUCCESS);
    tell(0x03, 0x4138);
    tell(0x01, 0x0101);
    int size = 0;
    std::array<unsigned char, 3> question{0x0A, 0x43, 0x0D};
    ASSERT_EQ(libusb_bulk_transfer(handle_, 0x02, question.data(), 3, &size, 1000), LIBUSB_SUCCESS);
    EXPECT_EQ(size, 3);
    std::array<unsigned char, 3> small{};
    int result = LIBUSB_SUCCESS;
    for (int i = 0; i < 5 && result == LIBUSB_SUCCESS; ++i)
        result = libusb_bulk_transfer(handle_, 0x81, small.data(), small.size(), &size, 1000);
    EXPECT_EQ(result, LIBUSB_ERROR_OVERFLOW);
}

TEST_F(UsbDevice, TakesNothingThroughAnInterfaceThatIsNotClaimed) {
    std::array<unsigned char, 64> buffer{};
    int size = 0;
    EXPECT_NE(libusb_bulk_transfer(handle_, 0x81, buffer.data(), buffer.size(), &size, 10), LIBUSB_SUCCESS);
}

TEST_F(UsbDevice, IsGoneForWhoeverHeldItOnceItIsUnplugged) {
    UsbRig::bus().unplug(*port_);
    EXPECT_EQ(tell(0x09, 1), LIBUSB_ERROR_NO_DEVICE);
    UsbRig::bus().replug(*port_, true);
    EXPECT_EQ(tell(0x09, 1), LIBUSB_ERROR_NO_DEVICE) << "an old handle does not come back to life";
}

}  // namespace
}  // namespace eddy
