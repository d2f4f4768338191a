#include "hal/haptic/falcon/usb_link.h"

#include <fmt/format.h>
#include <libusb.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace eddy::falcon {
namespace {

using namespace std::chrono_literals;

constexpr std::uint8_t kBulkIn = 0x81;  // libnifalcon FalconCommLibUSB.cpp
constexpr std::uint8_t kBulkOut = 0x02;
constexpr int kInterface = 0;

constexpr Instant kSearchPeriod = 100ms;
constexpr Instant kControlTime = 1s;  // libnifalcon's time-out for control requests
constexpr Instant kOutTime = 200ms;   // the chip's buffer is never full at one frame per reply
constexpr Instant kForever = Instant::max();
// In a row; then the device is opened afresh, which clears an endpoint that halted. Reads: four of each.
constexpr int kFailedReads = 32, kFailedWrites = 4;

// USB 2.0 specification, 9.4.3: GET_DESCRIPTOR of a string, in US English.
constexpr ControlRequest get_string(std::uint8_t index) {
    return {LIBUSB_ENDPOINT_IN, LIBUSB_REQUEST_GET_DESCRIPTOR,
            static_cast<std::uint16_t>(LIBUSB_DT_STRING << 8 | index), 0x0409};
}

bool is_falcon(libusb_device* device, libusb_device_descriptor& descriptor) {
    return libusb_get_device_descriptor(device, &descriptor) == LIBUSB_SUCCESS &&
           descriptor.idVendor == kVendor && descriptor.idProduct == kProduct;
}

/// The devices plugged in now.
class DeviceList {
  public:
    explicit DeviceList(libusb_context* context) {
        const auto count = libusb_get_device_list(context, &devices_);
        if (count > 0) count_ = static_cast<std::size_t>(count);
    }
    ~DeviceList() {
        if (devices_) libusb_free_device_list(devices_, 1);
    }
    DeviceList(const DeviceList&) = delete;
    DeviceList& operator=(const DeviceList&) = delete;
    libusb_device** begin() const { return devices_; }
    libusb_device** end() const { return devices_ + count_; }

  private:
    libusb_device** devices_ = nullptr;
    std::size_t count_ = 0;
};

Obstacle obstacle_from(int error) {
    if (error == LIBUSB_ERROR_ACCESS) return Obstacle::Denied;
    if (error == LIBUSB_ERROR_BUSY) return Obstacle::Busy;
    return Obstacle::Unusable;
}

}  // namespace

UsbLink::UsbLink(std::string serial) : wanted_(std::move(serial)) {
    if (const int error = libusb_init(&context_); error != LIBUSB_SUCCESS)
        throw std::runtime_error(fmt::format("libusb does not start: {}", libusb_strerror(error)));
    const auto equip = [this](Slot& slot) {
        slot.owner = this;
        slot.transfer = libusb_alloc_transfer(0);
        if (!slot.transfer) throw std::bad_alloc();
    };
    equip(control_);
    equip(out_);
    for (Slot& read : reads_) equip(read);
}

UsbLink::~UsbLink() {
    close({});
    // A transfer that the kernel never gave back is better lost than freed under it.
    if (under_way_ == 0) {
        libusb_free_transfer(control_.transfer);
        libusb_free_transfer(out_.transfer);
        for (Slot& read : reads_) libusb_free_transfer(read.transfer);
        libusb_exit(context_);
    }
}

void UsbLink::poll(Instant now) {
    now_ = now;
    timeval no_wait{0, 0};
    libusb_handle_events_timeout_completed(context_, &no_wait, nullptr);
    if (stage_ == Stage::Naming) naming();
    if (stage_ == Stage::Open) upkeep();
    if (stage_ == Stage::Leaving && under_way_ == 0) shut();
    if (stage_ == Stage::Searching && now_ >= search_at_) search();
}

std::string_view UsbLink::serial() const {
    return present() ? std::string_view(name_.data(), name_size_) : std::string_view();
}

void UsbLink::search() {
    search_at_ = now_ + kSearchPeriod;
    std::size_t passed_over = 0;
    for (libusb_device* device : DeviceList(context_)) {
        libusb_device_descriptor descriptor{};
        if (!is_falcon(device, descriptor)) continue;
        if (passed_over++ < candidate_) continue;
        ++candidate_;
        if (const int error = libusb_open(device, &handle_); error != LIBUSB_SUCCESS) {
            obstacle_ = obstacle_from(error);
            continue;
        }
        gone_ = false;
        failed_reads_ = failed_writes_ = 0;
        return ask_name(descriptor.iSerialNumber);
    }
    // None left to try; the next search begins with the first again, and knows nothing of this one.
    if (passed_over == 0) obstacle_ = Obstacle::NotFound;
    candidate_ = 0;
}

void UsbLink::ask_name(std::uint8_t index) {
    stage_ = Stage::Naming;
    submit_control(get_string(index), kLongestString);
}

void UsbLink::naming() {
    if (control_.state == Transfer::Pending) return cancel_if_late(control_);
    name_size_ = 0;
    if (control_.state == Transfer::Done) {
        // Length, type, then UTF-16 with the low byte first.
        const auto length = static_cast<std::size_t>(std::max(control_.transfer->actual_length, 0));
        for (std::size_t i = 2; i + 1 < length && name_size_ < name_.size(); i += 2) {
            const std::uint8_t low = control_.bytes[kSetupBytes + i];
            const bool plain = control_.bytes[kSetupBytes + i + 1] == 0 && low > 0x20 && low < 0x7F;
            name_[name_size_++] = plain ? static_cast<char>(low) : '?';
        }
    }
    if (!wanted_.empty() && wanted_ != std::string_view(name_.data(), name_size_)) {
        obstacle_ = control_.state == Transfer::Done ? Obstacle::OtherSerial : Obstacle::Unusable;
        return leave();
    }
    take_over();
}

void UsbLink::take_over() {
    // ftdi_sio does not know the Falcon's number, but may have been told it.
    libusb_set_auto_detach_kernel_driver(handle_, 1);
    if (const int error = libusb_claim_interface(handle_, kInterface); error != LIBUSB_SUCCESS) {
        obstacle_ = obstacle_from(error);
        return leave();
    }
    claimed_ = true;
    libusb_clear_halt(handle_, kBulkIn);
    libusb_clear_halt(handle_, kBulkOut);
    stage_ = Stage::Open;
    candidate_ = 0;
    control_.state = out_.state = Transfer::Done;
    for (Slot& read : reads_) listen(read);
}

void UsbLink::upkeep() {
    if (gone_ || failed_reads_ >= kFailedReads || failed_writes_ >= kFailedWrites) {
        obstacle_ = gone_ ? Obstacle::NotFound : Obstacle::Unusable;
        return leave();
    }
    cancel_if_late(control_);
    cancel_if_late(out_);
    for (Slot& read : reads_)
        if (read.state == Transfer::Failed) listen(read);
}

void UsbLink::leave() {
    stage_ = Stage::Leaving;
    filled_count_ = 0;
    const auto cancel = [](Slot& slot) {
        if (slot.state == Transfer::Pending) libusb_cancel_transfer(slot.transfer);
    };
    cancel(control_);
    cancel(out_);
    for (Slot& read : reads_) cancel(read);
}

void UsbLink::shut() {
    if (std::exchange(claimed_, false)) libusb_release_interface(handle_, kInterface);
    libusb_close(std::exchange(handle_, nullptr));
    stage_ = Stage::Searching;
    // One that was passed over leaves the turn to the next; one that was in use is given a little time.
    search_at_ = candidate_ > 0 ? now_ : now_ + kSearchPeriod;
}

bool UsbLink::submit(Slot& slot, Instant time_allowed) {
    const int error = libusb_submit_transfer(slot.transfer);
    if (error == LIBUSB_SUCCESS) {
        slot.state = Transfer::Pending;
        slot.deadline = time_allowed == kForever ? kForever : now_ + time_allowed;
        ++under_way_;
        return true;
    }
    slot.state = Transfer::Failed;
    if (error == LIBUSB_ERROR_NO_DEVICE)
        gone_ = true;
    else
        ++failures_;
    return false;
}

void UsbLink::submit_control(const ControlRequest& request) {
    submit_control(request, 0);
}

void UsbLink::submit_control(const ControlRequest& request, std::uint16_t length) {
    if (!handle_ || control_.state == Transfer::Pending) return;
    libusb_fill_control_setup(control_.bytes.data(), request.type, request.request, request.value,
                              request.index, length);
    libusb_fill_control_transfer(control_.transfer, handle_, control_.bytes.data(), on_finished, &control_,
                                 0);
    submit(control_, kControlTime);
}

void UsbLink::submit_out(std::span<const std::uint8_t> bytes) {
    if (!handle_ || out_.state == Transfer::Pending) return;
    const std::size_t size = std::min(bytes.size(), kPacketBytes);
    std::copy_n(bytes.begin(), size, out_.bytes.begin());
    libusb_fill_bulk_transfer(out_.transfer, handle_, kBulkOut, out_.bytes.data(), static_cast<int>(size),
                              on_finished, &out_, 0);
    if (!submit(out_, kOutTime)) ++failed_writes_;
}

/// Asks for the next packet. A buffer of whole packets: in a smaller one a long packet would overflow.
void UsbLink::listen(Slot& slot) {
    libusb_fill_bulk_transfer(slot.transfer, handle_, kBulkIn, slot.bytes.data(), kPacketBytes, on_finished,
                              &slot, 0);
    if (!submit(slot, kForever)) ++failed_reads_;
}

bool UsbLink::take_in(Packet& packet) {
    if (filled_count_ == 0 || stage_ != Stage::Open) return false;
    Slot& slot = *filled_[0];
    std::copy(filled_.begin() + 1, filled_.end(), filled_.begin());
    --filled_count_;
    packet.size = static_cast<std::size_t>(slot.transfer->actual_length);
    std::copy_n(slot.bytes.begin(), packet.size, packet.bytes.begin());
    packet.arrived_at = slot.deadline;
    listen(slot);
    return true;
}

void UsbLink::on_finished(libusb_transfer* transfer) {
    Slot& slot = *static_cast<Slot*>(transfer->user_data);
    slot.owner->finished(slot);
}

void UsbLink::finished(Slot& slot) {
    --under_way_;
    const auto status = slot.transfer->status;
    const bool is_read = &slot != &control_ && &slot != &out_;
    slot.state = status == LIBUSB_TRANSFER_COMPLETED ? Transfer::Done : Transfer::Failed;
    if (status == LIBUSB_TRANSFER_NO_DEVICE) gone_ = true;
    const bool wrong = slot.state == Transfer::Failed && !gone_ && stage_ != Stage::Leaving;
    if (wrong) ++failures_;
    if (&slot == &out_) failed_writes_ = wrong ? failed_writes_ + 1 : 0;
    if (!is_read) return;
    if (wrong) {
        ++failed_reads_;
    } else if (slot.state == Transfer::Done && stage_ == Stage::Open) {
        failed_reads_ = 0;
        slot.deadline = now_;  // from here on: when it came
        filled_[filled_count_++] = &slot;
    }
}

void UsbLink::cancel_if_late(Slot& slot) const {
    if (slot.state == Transfer::Pending && now_ > slot.deadline) libusb_cancel_transfer(slot.transfer);
}

template <typename Done>
void UsbLink::wait_for(Done done) {
    const auto end = std::chrono::steady_clock::now() + 50ms;
    while (!done() && std::chrono::steady_clock::now() < end) {
        timeval at_most{0, 5000};
        libusb_handle_events_timeout_completed(context_, &at_most, nullptr);
    }
}

void UsbLink::close(std::span<const std::uint8_t> last_words) {
    if (present() && !last_words.empty()) {
        wait_for([this] { return out_.state != Transfer::Pending; });
        submit_out(last_words);
        wait_for([this] { return out_.state != Transfer::Pending; });
    }
    if (!handle_) return;
    leave();
    wait_for([this] { return under_way_ == 0; });
    if (under_way_ == 0) shut();
}

bool falcon_is_plugged_in() {
    libusb_context* context = nullptr;
    if (libusb_init(&context) != LIBUSB_SUCCESS) return false;
    bool found = false;
    for (libusb_device* device : DeviceList(context)) {
        libusb_device_descriptor descriptor{};
        found = found || is_falcon(device, descriptor);
    }
    libusb_exit(context);
    return found;
}

}  // namespace eddy::falcon
