#include "tests/usb/bus.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <utility>

namespace eddy::usb {
namespace {

using emulated::Urb;

constexpr int kBus = 1;
/// What Linux 6 says it can do.
constexpr unsigned kCapabilities = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION |
                                   USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_BULK_SCATTER_GATHER |
                                   USBDEVFS_CAP_REAP_AFTER_DISCONNECT;

int fail(int error) {
    errno = error;
    return -1;
}

/// close() of this program is usbfs.cpp's.
void close_for_real(int fd) {
    syscall(SYS_close, fd);
}

Instant machine_time() {
    return std::chrono::steady_clock::now().time_since_epoch();
}

Urb urb_of(const usbdevfs_urb& urb) {
    auto* bytes = static_cast<std::uint8_t*>(urb.buffer);
    const auto pipe = urb.type == USBDEVFS_URB_TYPE_CONTROL ? Urb::Pipe::Control
                      : (urb.endpoint & 0x80) != 0          ? Urb::Pipe::In
                                                            : Urb::Pipe::Out;
    return {.id = &urb, .pipe = pipe, .buffer = {bytes, static_cast<std::size_t>(urb.buffer_length)}};
}

int status_of(Urb::Status status) {
    switch (status) {
        case Urb::Status::Pending:
        case Urb::Status::Done:
            return 0;
        case Urb::Status::Stalled:
            return -EPIPE;
        case Urb::Status::Overflowed:
            return -EOVERFLOW;
        case Urb::Status::Garbled:
            return -EPROTO;
        case Urb::Status::Cancelled:
            return -ENOENT;
        case Urb::Status::Gone:
            return -ESHUTDOWN;
    }
    return -EPROTO;
}

}  // namespace

thread_local int InKernel::depth_ = 0;

Bus& Bus::instance() {
    static Bus& bus = *new Bus;  // the last close() of a program may come after its last destructor
    return bus;
}

Port& Bus::plug(std::unique_ptr<emulated::EmulatedFalcon> falcon, emulated::UsbIdentity identity) {
    const std::lock_guard lock(mutex_);
    const auto port_number = ports_.size() + 1;
    ports_.push_back(std::make_unique<Port>(fmt::format("{}-{}", kBus, port_number), std::move(falcon),
                                            std::move(identity)));
    Port& port = *ports_.back();
    port.address = next_address_++;
    port.plugged_in = true;
    port.device.poll(now());
    announce("add", port);
    return port;
}

void Bus::unplug(Port& port) {
    const std::lock_guard lock(mutex_);
    port.device.unplug();
    announce("remove", port);
    port.plugged_in = false;
    port.claimed_by_another = false;
    refresh();
}

void Bus::replug(Port& port, bool kept_power) {
    const std::lock_guard lock(mutex_);
    port.device.poll(now());
    port.device.plug_in(kept_power);
    port.address = next_address_;
    next_address_ = next_address_ == 127 ? 2 : next_address_ + 1;  // addresses are seven bits, and come round
    port.plugged_in = true;
    announce("add", port);
}

void Bus::clear() {
    const std::lock_guard lock(mutex_);
    for (const auto& port : ports_)
        if (port->plugged_in) unplug(*port);
    ports_.clear();
    while (next_event()) {
    }
}

void Bus::advance(Instant now) {
    const std::lock_guard lock(mutex_);
    now_ = std::max(now_, now);
    refresh();
}

void Bus::use_real_time() {
    real_start_ = machine_time();
}

Instant Bus::now() const {
    const std::lock_guard lock(mutex_);
    return real_start_ ? machine_time() - *real_start_ : now_;
}

void Bus::announce(const char* action, const Port& port) {
    event_fd();
    events_.push_back({action, port.sysname, fmt::format("/dev/bus/usb/{:03}/{:03}", kBus, port.address)});
    const char token = 1;
    static_cast<void>(!write(event_pipe_[1], &token, 1));
}

int Bus::event_fd() {
    const std::lock_guard lock(mutex_);
    if (event_pipe_[0] < 0 && pipe2(event_pipe_, O_NONBLOCK | O_CLOEXEC) != 0) std::abort();
    return event_pipe_[0];
}

std::optional<Bus::Event> Bus::next_event() {
    const std::lock_guard lock(mutex_);
    if (events_.empty()) return std::nullopt;
    char token = 0;
    static_cast<void>(!read(event_pipe_[0], &token, 1));
    Event event = std::move(events_.front());
    events_.pop_front();
    return event;
}

std::vector<std::string> Bus::sysnames() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> names;
    for (const auto& port : ports_)
        if (port->plugged_in) names.push_back(port->sysname);
    return names;
}

std::optional<std::string> Bus::sysfs_file(const std::string& sysname, const std::string& attribute) const {
    const std::lock_guard lock(mutex_);
    for (const auto& port : ports_) {
        if (!port->plugged_in || port->sysname != sysname) continue;
        if (attribute == "busnum") return fmt::format("{}\n", kBus);
        if (attribute == "devnum") return fmt::format("{}\n", port->address);
        if (attribute == "speed") return "12\n";
        if (attribute == "bConfigurationValue") return "1\n";
        const auto descriptors = port->device.descriptors();
        if (attribute == "descriptors") return std::string(descriptors.begin(), descriptors.end());
    }
    return std::nullopt;
}

int Bus::open_device(int bus, int address) {
    const std::lock_guard lock(mutex_);
    for (const auto& port : ports_) {
        if (!port->plugged_in || bus != kBus || port->address != address) continue;
        if (port->denied) return fail(EACCES);
        // poll() must find the file writable when a request has ended, and in error when the device has gone. The
        // writing end of a pipe of one page behaves so: full, emptied, without a reader.
        int ends[2];
        if (pipe2(ends, O_NONBLOCK | O_CLOEXEC) != 0) return -1;
        if (fcntl(ends[1], F_SETPIPE_SZ, 4096) < 0) return -1;
        File& file = files_[ends[1]];
        file = {.port = port.get(), .address = address, .read_end = ends[0], .quiet = false};
        set_quiet(file, ends[1], true);
        ++port->opened;
        return ends[1];
    }
    return fail(ENOENT);
}

void Bus::close_device(int fd) {
    const std::lock_guard lock(mutex_);
    const auto found = files_.find(fd);
    if (found == files_.end()) return;
    File& file = found->second;
    for (const auto& [id, urb] : file.urbs) file.port->device.cancel(id);
    collect();
    if (file.read_end >= 0) close_for_real(file.read_end);
    files_.erase(found);
    close_for_real(fd);
}

void Bus::set_quiet(File& file, int fd, bool quiet) {
    if (file.read_end < 0 || file.quiet == quiet) return;
    char token = 1;
    static_cast<void>(quiet ? !write(fd, &token, 1) : !read(file.read_end, &token, 1));
    file.quiet = quiet;
}

void Bus::collect() {
    for (const auto& port : ports_) {
        while (const auto ended = port->device.reap()) {
            for (auto& [fd, file] : files_) {
                const auto found = file.urbs.find(ended->id);
                if (found == file.urbs.end()) continue;
                usbdevfs_urb& urb = *found->second;
                urb.status = status_of(ended->status);
                urb.actual_length = static_cast<int>(ended->actual);
                file.ended.push_back(&urb);
                file.urbs.erase(found);
                break;
            }
        }
    }
}

void Bus::refresh() {
    const std::lock_guard lock(mutex_);
    for (const auto& port : ports_) port->device.poll(now());
    collect();
    for (auto& [fd, file] : files_) {
        set_quiet(file, fd, file.ended.empty());
        if (!alive(file) && file.read_end >= 0) close_for_real(std::exchange(file.read_end, -1));
    }
}

int Bus::claim(File& file, bool take_from_driver) {
    if (file.port->claimed_by_another) return fail(EBUSY);
    if (file.port->bound_to_driver && !take_from_driver) return fail(EBUSY);
    file.port->bound_to_driver = false;
    file.claimed = true;
    ++file.port->claimed;
    return 0;
}

int Bus::ioctl(int fd, unsigned long request, void* argument) {
    const std::lock_guard lock(mutex_);
    refresh();
    File& file = files_.at(fd);
    auto* urb = static_cast<usbdevfs_urb*>(argument);
    // Requests that have ended can be had even of a device that has gone.
    if (request == USBDEVFS_REAPURBNDELAY) {
        if (file.ended.empty()) return fail(alive(file) ? EAGAIN : ENODEV);
        *static_cast<usbdevfs_urb**>(argument) = file.ended.front();
        file.ended.pop_front();
        refresh();
        return 0;
    }
    if (!alive(file)) return fail(ENODEV);
    switch (request) {
        case USBDEVFS_GET_CAPABILITIES:
            *static_cast<unsigned*>(argument) = kCapabilities;
            return 0;
        case USBDEVFS_CLAIMINTERFACE:
            return claim(file, false);
        case USBDEVFS_DISCONNECT_CLAIM:
            return claim(file, true);
        case USBDEVFS_RELEASEINTERFACE:
            file.claimed = false;
            return 0;
        case USBDEVFS_SUBMITURB:
            // The kernel claims the interface for a careless program; ours is not to be one.
            if (urb->type == USBDEVFS_URB_TYPE_BULK && !file.claimed) return fail(EINVAL);
            urb->status = -EINPROGRESS;
            urb->actual_length = 0;
            file.urbs[urb] = urb;
            file.port->device.submit(urb_of(*urb));
            refresh();
            return 0;
        case USBDEVFS_DISCARDURB:
            if (!file.port->device.cancel(urb)) return fail(EINVAL);
            refresh();
            return 0;
        case USBDEVFS_CLEAR_HALT:
            return file.port->device.clear_halt(
                       static_cast<std::uint8_t>(*static_cast<const unsigned*>(argument)))
                       ? 0
                       : fail(EPIPE);
        case USBDEVFS_IOCTL: {
            // A driver of the kernel is told to let the interface go, or to take it back.
            const auto* inner = static_cast<const usbdevfs_ioctl*>(argument);
            if (inner->ioctl_code == USBDEVFS_DISCONNECT && !file.port->bound_to_driver) return fail(ENODATA);
            file.port->bound_to_driver = false;
            return 0;
        }
        case USBDEVFS_GETDRIVER:
            return fail(ENODATA);
        default:
            return fail(ENOTTY);
    }
}

}  // namespace eddy::usb
