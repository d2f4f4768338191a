// The functions of the C library and of libudev by which libusb reaches the kernel, redefined: what concerns USB goes
// to usb::Bus, everything else to the kernel. Linked into a test program these definitions come before the library's;
// in a shared object they do when it is preloaded. Each has a name of its own here, and the library's name for the
// linker, so that the library's inline variants of them do no harm.

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "tests/usb/bus.h"

namespace {

using eddy::Instant;
using eddy::usb::Bus;
using eddy::usb::InKernel;
using namespace std::chrono_literals;

constexpr std::string_view kSysfs = "/sys/bus/usb/devices/";
constexpr std::string_view kDeviceFiles = "/dev/bus/usb/";
constexpr long kSysfsMagic = 0x62656572;  // linux/magic.h
constexpr Instant kSlice = 100us;         // of time that poll() waits at once

int open_for_real(const char* path, int flags, unsigned mode) {
    return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

/// A file that holds this text.
int file_with(const std::string& text) {
    const auto fd = static_cast<int>(syscall(SYS_memfd_create, "sysfs", 1U));
    if (fd < 0 || write(fd, text.data(), text.size()) < 0) return -1;
    lseek(fd, 0, SEEK_SET);
    return fd;
}

int open_any(const char* path, int flags, unsigned mode) {
    const InKernel kernel;
    const std::string_view name(path);
    if (name.starts_with(kDeviceFiles)) {
        int bus = 0, address = 0;
        if (std::sscanf(path + kDeviceFiles.size(), "%d/%d", &bus, &address) == 2)
            return Bus::instance().open_device(bus, address);
    }
    if (name.starts_with(kSysfs)) {
        const std::string rest(name.substr(kSysfs.size()));
        const std::size_t slash = rest.find('/');
        const auto text = slash == std::string::npos
                              ? std::nullopt
                              : Bus::instance().sysfs_file(rest.substr(0, slash), rest.substr(slash + 1));
        if (text) return file_with(*text);
        errno = ENOENT;
        return -1;
    }
    return open_for_real(path, flags, mode);
}

int poll_for_real(pollfd* fds, nfds_t count, int timeout_ms) {
    timespec time{timeout_ms / 1000, timeout_ms % 1000 * 1000000L};
    return static_cast<int>(syscall(SYS_ppoll, fds, count, timeout_ms < 0 ? nullptr : &time, nullptr, 0));
}

bool concerns_usb(const pollfd* fds, nfds_t count) {
    const std::lock_guard lock(Bus::instance().mutex());
    return std::any_of(fds, fds + count, [](const pollfd& p) { return Bus::instance().is_open(p.fd); });
}

}  // namespace

extern "C" {

int eddy_open(const char* path, int flags, ...) __asm__("open");
int eddy_open64(const char* path, int flags, ...) __asm__("open64");
int eddy_open_2(const char* path, int flags) __asm__("__open_2");
int eddy_open64_2(const char* path, int flags) __asm__("__open64_2");
int eddy_close(int fd) __asm__("close");
int eddy_ioctl(int fd, unsigned long request, ...) __asm__("ioctl");
int eddy_poll(pollfd* fds, nfds_t count, int timeout_ms) __asm__("poll");
int eddy_statfs(const char* path, struct statfs* out) __asm__("statfs");

int eddy_open(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const unsigned mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, unsigned) : 0U;
    va_end(rest);
    return open_any(path, flags, mode);
}
int eddy_open64(const char* path, int flags, ...) {
    va_list rest;
    va_start(rest, flags);
    const unsigned mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, unsigned) : 0U;
    va_end(rest);
    return open_any(path, flags, mode);
}
int eddy_open_2(const char* path, int flags) {
    return open_any(path, flags, 0);
}
int eddy_open64_2(const char* path, int flags) {
    return open_any(path, flags, 0);
}

int eddy_close(int fd) {
    const InKernel kernel;
    {
        const std::lock_guard lock(Bus::instance().mutex());
        if (Bus::instance().is_open(fd)) {
            Bus::instance().close_device(fd);
            return 0;
        }
    }
    return static_cast<int>(syscall(SYS_close, fd));
}

int eddy_ioctl(int fd, unsigned long request, ...) {
    const InKernel kernel;
    va_list rest;
    va_start(rest, request);
    void* argument = va_arg(rest, void*);
    va_end(rest);
    {
        const std::lock_guard lock(Bus::instance().mutex());
        if (Bus::instance().is_open(fd)) return Bus::instance().ioctl(fd, request, argument);
    }
    return static_cast<int>(syscall(SYS_ioctl, fd, request, argument));
}

int eddy_poll(pollfd* fds, nfds_t count, int timeout_ms) {
    const InKernel kernel;
    if (!concerns_usb(fds, count)) return poll_for_real(fds, count, timeout_ms);
    Bus& bus = Bus::instance();
    const Instant end = timeout_ms < 0 ? Instant::max() : bus.now() + std::chrono::milliseconds(timeout_ms);
    for (;;) {
        bus.refresh();
        const int ready = poll_for_real(fds, count, 0);
        if (ready != 0 || bus.now() >= end) return ready;
        if (bus.virtual_time()) {
            bus.advance(bus.now() + kSlice);
        } else {
            const timespec slice{0, kSlice.count()};
            nanosleep(&slice, nullptr);
        }
    }
}

/// Where sysfs is not mounted (in a container), libusb would look for device files.
int eddy_statfs(const char* path, struct statfs* out) {
    if (std::strcmp(path, "/sys") != 0) return static_cast<int>(syscall(SYS_statfs, path, out));
    *out = {};
    out->f_type = kSysfsMagic;
    return 0;
}

// --- libudev: who is plugged in, and who comes and goes ---------------------------------------------------------

struct udev {};
struct udev_monitor {};
struct udev_list_entry {
    std::string name;
    std::unique_ptr<udev_list_entry> next;
};
struct udev_enumerate {
    std::unique_ptr<udev_list_entry> first;
};
struct udev_device {
    std::string action, sysname, device_file;
};

udev* udev_new() {
    const InKernel kernel;
    return new udev;
}
udev* udev_unref(udev* context) {
    const InKernel kernel;
    delete context;
    return nullptr;
}
udev_monitor* udev_monitor_new_from_netlink(udev*, const char*) {
    const InKernel kernel;
    return new udev_monitor;
}
udev_monitor* udev_monitor_unref(udev_monitor* monitor) {
    const InKernel kernel;
    delete monitor;
    return nullptr;
}
int udev_monitor_filter_add_match_subsystem_devtype(udev_monitor*, const char*, const char*) {
    return 0;
}
int udev_monitor_enable_receiving(udev_monitor*) {
    return 0;
}
int udev_monitor_get_fd(udev_monitor*) {
    return Bus::instance().event_fd();
}
udev_device* udev_monitor_receive_device(udev_monitor*) {
    const InKernel kernel;
    const auto event = Bus::instance().next_event();
    return event ? new udev_device{event->action, event->sysname, event->device_file} : nullptr;
}

udev_enumerate* udev_enumerate_new(udev*) {
    const InKernel kernel;
    return new udev_enumerate;
}
udev_enumerate* udev_enumerate_unref(udev_enumerate* list) {
    const InKernel kernel;
    delete list;
    return nullptr;
}
int udev_enumerate_add_match_subsystem(udev_enumerate*, const char*) {
    return 0;
}
int udev_enumerate_add_match_property(udev_enumerate*, const char*, const char*) {
    return 0;
}
int udev_enumerate_scan_devices(udev_enumerate* list) {
    const InKernel kernel;
    for (const std::string& name : Bus::instance().sysnames())
        list->first = std::make_unique<udev_list_entry>(
            udev_list_entry{std::string(kSysfs) + name, std::move(list->first)});
    return 0;
}
udev_list_entry* udev_enumerate_get_list_entry(udev_enumerate* list) {
    return list->first.get();
}
udev_list_entry* udev_list_entry_get_next(udev_list_entry* entry) {
    return entry->next.get();
}
const char* udev_list_entry_get_name(udev_list_entry* entry) {
    return entry->name.c_str();
}

udev_device* udev_device_new_from_syspath(udev*, const char* path) {
    const InKernel kernel;
    const std::string sysname = std::string(path).substr(kSysfs.size());
    const auto address = Bus::instance().sysfs_file(sysname, "devnum");
    if (!address) return nullptr;
    return new udev_device{"", sysname, fmt::format("/dev/bus/usb/001/{:03}", std::stoi(*address))};
}
udev_device* udev_device_unref(udev_device* device) {
    const InKernel kernel;
    delete device;
    return nullptr;
}
const char* udev_device_get_action(udev_device* device) {
    return device->action.c_str();
}
const char* udev_device_get_devnode(udev_device* device) {
    return device ? device->device_file.c_str() : nullptr;
}
const char* udev_device_get_sysname(udev_device* device) {
    return device->sysname.c_str();
}

}  // extern "C"
