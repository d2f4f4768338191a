#include "tests/gpio/kernel.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <string_view>

namespace eddy::gpio {
namespace {

/// Not the C library's: that is what stands below.
int close_for_real(int fd) {
    return static_cast<int>(syscall(SYS_close, fd));
}

template <std::size_t N>
void put(char (&field)[N], const std::string& text) {
    std::strncpy(field, text.c_str(), N - 1);
    field[N - 1] = '\0';
}

int fail(int error) {
    errno = error;
    return -1;
}

}  // namespace

Kernel& Kernel::instance() {
    static Kernel kernel;
    return kernel;
}

Chip& Kernel::add(const std::filesystem::path& file, const std::string& label,
                  const std::vector<std::string>& names, bool edges) {
    const std::lock_guard lock(mutex_);
    Chip& chip = chips_.emplace_back();
    chip.label = label;
    chip.edges = edges;
    chip.file = file;
    for (const std::string& name : names) chip.lines.push_back({.name = name});
    return chip;
}

void Kernel::unplug(Chip& chip) {
    const std::lock_guard lock(mutex_);
    std::filesystem::remove(chip.file);
    chip.file.clear();
    for (auto& [fd, open] : open_)
        if (open.chip == &chip) {
            open.chip = nullptr;
            if (open.far_end >= 0) close_for_real(open.far_end);
            open.far_end = -1;
        }
    for (Line& line : chip.lines) line = {.name = line.name, .high = line.high};
}

void Kernel::plug_in(Chip& chip, const std::filesystem::path& file) {
    const std::lock_guard lock(mutex_);
    chip.file = file;
}

void Kernel::clear() {
    const std::lock_guard lock(mutex_);
    for (Chip& chip : chips_)
        if (!chip.file.empty()) unplug(chip);
    chips_.clear();
}

void Kernel::set_high(Chip& chip, std::size_t line, bool high) {
    const std::lock_guard lock(mutex_);
    change(chip, line, high);
}

bool Kernel::is_high(const Chip& chip, std::size_t line) {
    const std::lock_guard lock(mutex_);
    return chip.lines[line].high;
}

void Kernel::change(Chip& chip, std::size_t line, bool high) {
    if (chip.lines[line].high == high) return;
    chip.lines[line].high = high;
    for (const auto& [fd, open] : open_) {
        if (open.chip != &chip || !open.tells_edges || open.line != line) continue;
        const bool rises = high != open.active_low;
        ssize_t written = 0;
        if (open.second) {
            gpio_v2_line_event event{};
            event.id = rises ? GPIO_V2_LINE_EVENT_RISING_EDGE : GPIO_V2_LINE_EVENT_FALLING_EDGE;
            event.offset = static_cast<std::uint32_t>(line);
            written = ::write(open.far_end, &event, sizeof event);
        } else {
            gpioevent_data event{};
            event.id = rises ? GPIOEVENT_EVENT_RISING_EDGE : GPIOEVENT_EVENT_FALLING_EDGE;
            written = ::write(open.far_end, &event, sizeof event);
        }
        static_cast<void>(written);  // a full queue drops, as the kernel's does
    }
}

Chip* Kernel::chip_at(const char* path) {
    const std::lock_guard lock(mutex_);
    for (Chip& chip : chips_)
        if (!chip.file.empty() && chip.file == path) return &chip;
    return nullptr;
}

int Kernel::open_chip(Chip& chip) {
    const std::lock_guard lock(mutex_);
    if (chip.refusal != 0) return fail(chip.refusal);
    const int fd = static_cast<int>(syscall(SYS_memfd_create, "gpiochip", 1U));
    Open open;
    open.chip = &chip;
    open_[fd] = open;
    return fd;
}

bool Kernel::has_chips() {
    const std::lock_guard lock(mutex_);
    return !chips_.empty();
}

bool Kernel::is_open(int fd) {
    const std::lock_guard lock(mutex_);
    return open_.contains(fd);
}

void Kernel::close(int fd) {
    const std::lock_guard lock(mutex_);
    const Open open = open_.at(fd);
    if (open.is_line && open.chip) {
        Line& line = open.chip->lines[open.line];
        line = {.name = line.name, .high = line.high};
    }
    if (open.far_end >= 0) close_for_real(open.far_end);
    open_.erase(fd);
    close_for_real(fd);
}

int Kernel::ioctl(int fd, unsigned long request, void* argument) {
    const std::lock_guard lock(mutex_);
    Open& open = open_.at(fd);
    if (!open.chip) return fail(ENODEV);
    return open.is_line ? line_ioctl(open, request, argument) : chip_ioctl(open, request, argument);
}

int Kernel::request(Chip& chip, std::size_t line, const char* consumer, Open wish, bool pull_up, bool value) {
    if (line >= chip.lines.size()) return fail(EINVAL);
    if (pull_up && !chip.biases) return fail(EINVAL);
    if (chip.lines[line].used) return fail(EBUSY);
    // Each generation has its own word for a line that cannot interrupt (gpiolib-cdev.c).
    if (wish.tells_edges && !chip.edges) return fail(wish.second ? ENXIO : ENODEV);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) < 0) return -1;
    fcntl(ends[0], F_SETFL, 0);
    chip.pull_ups += pull_up;
    chip.lines[line].used = true;
    chip.lines[line].consumer = consumer;
    chip.lines[line].output = wish.output;
    if (wish.output) change(chip, line, value != wish.active_low);
    wish.chip = &chip;
    wish.is_line = true;
    wish.line = line;
    wish.far_end = ends[1];
    open_[ends[0]] = wish;
    return ends[0];
}

int Kernel::chip_ioctl(Open& open, unsigned long request, void* argument) {
    Chip& chip = *open.chip;
    const auto known = [&chip](std::uint32_t offset) { return offset < chip.lines.size(); };
    switch (request) {
        case GPIO_GET_CHIPINFO_IOCTL: {
            auto& info = *static_cast<gpiochip_info*>(argument);
            put(info.name, chip.file.filename().string());
            put(info.label, chip.label);
            info.lines = static_cast<std::uint32_t>(chip.lines.size());
            return 0;
        }
        case GPIO_GET_LINEINFO_IOCTL: {
            auto& info = *static_cast<gpioline_info*>(argument);
            if (!known(info.line_offset)) return fail(EINVAL);
            const Line& line = chip.lines[info.line_offset];
            put(info.name, line.name);
            put(info.consumer, line.consumer);
            info.flags = static_cast<std::uint32_t>((line.used ? GPIOLINE_FLAG_KERNEL : 0) |
                                                    (line.output ? GPIOLINE_FLAG_IS_OUT : 0));
            return 0;
        }
        case GPIO_V2_GET_LINEINFO_IOCTL: {
            auto& info = *static_cast<gpio_v2_line_info*>(argument);
            if (!known(info.offset)) return fail(EINVAL);
            const Line& line = chip.lines[info.offset];
            put(info.name, line.name);
            put(info.consumer, line.consumer);
            info.num_attrs = 0;
            info.flags = (line.used ? GPIO_V2_LINE_FLAG_USED : 0) |
                         (line.output ? GPIO_V2_LINE_FLAG_OUTPUT : GPIO_V2_LINE_FLAG_INPUT);
            return 0;
        }
        case GPIO_GET_LINEHANDLE_IOCTL: {
            auto& wish = *static_cast<gpiohandle_request*>(argument);
            Open line;
            line.active_low = (wish.flags & GPIOHANDLE_REQUEST_ACTIVE_LOW) != 0;
            line.output = (wish.flags & GPIOHANDLE_REQUEST_OUTPUT) != 0;
            wish.fd = this->request(chip, wish.lineoffsets[0], wish.consumer_label, line,
                                    (wish.flags & GPIOHANDLE_REQUEST_BIAS_PULL_UP) != 0,
                                    wish.default_values[0] != 0);
            return wish.fd < 0 ? -1 : 0;
        }
        case GPIO_GET_LINEEVENT_IOCTL: {
            auto& wish = *static_cast<gpioevent_request*>(argument);
            Open line;
            line.active_low = (wish.handleflags & GPIOHANDLE_REQUEST_ACTIVE_LOW) != 0;
            line.tells_edges = true;
            wish.fd = this->request(chip, wish.lineoffset, wish.consumer_label, line,
                                    (wish.handleflags & GPIOHANDLE_REQUEST_BIAS_PULL_UP) != 0, false);
            return wish.fd < 0 ? -1 : 0;
        }
        case GPIO_V2_GET_LINE_IOCTL: {
            auto& wish = *static_cast<gpio_v2_line_request*>(argument);
            Open line;
            line.second = true;
            line.active_low = (wish.config.flags & GPIO_V2_LINE_FLAG_ACTIVE_LOW) != 0;
            line.output = (wish.config.flags & GPIO_V2_LINE_FLAG_OUTPUT) != 0;
            line.tells_edges =
                (wish.config.flags & (GPIO_V2_LINE_FLAG_EDGE_RISING | GPIO_V2_LINE_FLAG_EDGE_FALLING)) != 0;
            bool value = false;
            for (std::uint32_t i = 0; i < wish.config.num_attrs; ++i)
                if (wish.config.attrs[i].attr.id == GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES)
                    value = (wish.config.attrs[i].attr.values & 1) != 0;
            wish.fd = this->request(chip, wish.offsets[0], wish.consumer, line,
                                    (wish.config.flags & GPIO_V2_LINE_FLAG_BIAS_PULL_UP) != 0, value);
            return wish.fd < 0 ? -1 : 0;
        }
        default:
            return fail(ENOTTY);
    }
}

int Kernel::line_ioctl(Open& open, unsigned long request, void* argument) {
    Chip& chip = *open.chip;
    const bool active = chip.lines[open.line].high != open.active_low;
    const auto set = [&](bool value) {
        if (!open.output) return fail(EPERM);
        change(chip, open.line, value != open.active_low);
        return 0;
    };
    switch (request) {
        case GPIOHANDLE_GET_LINE_VALUES_IOCTL:
            static_cast<gpiohandle_data*>(argument)->values[0] = active;
            return 0;
        case GPIOHANDLE_SET_LINE_VALUES_IOCTL:
            return set(static_cast<gpiohandle_data*>(argument)->values[0] != 0);
        case GPIO_V2_LINE_GET_VALUES_IOCTL:
            static_cast<gpio_v2_line_values*>(argument)->bits = active ? 1 : 0;
            return 0;
        case GPIO_V2_LINE_SET_VALUES_IOCTL:
            return set((static_cast<gpio_v2_line_values*>(argument)->bits & 1) != 0);
        default:
            return fail(ENOTTY);
    }
}

}  // namespace eddy::gpio

// The functions of the C library by which libgpiod reaches the kernel, redefined: what concerns a chip goes to gpio::Kernel, all
// else to the kernel. Each has a name of its own here, and the library's for the linker, as in tests/usb/usbfs.cpp.

namespace {

using eddy::gpio::Chip;
using eddy::gpio::Kernel;

// By these libgpiod makes sure that a file is a chip's: 1.6 by the first two, 2.x by the last.
constexpr unsigned kMajor = 511;  // no driver has it
constexpr std::string_view kDevices = "/sys/bus/gpio/devices/";
constexpr std::string_view kNumbers = "511:0\n";
constexpr std::string_view kSubsystemOf = "/sys/dev/char/511:";

/// Where there are chips of ours the machine has none.
bool is_of_ours(const char* path) {
    return std::string_view(path).starts_with(kDevices) && Kernel::instance().has_chips();
}

/// A file that holds the numbers of a chip's device file.
int open_numbers() {
    const auto fd = static_cast<int>(syscall(SYS_memfd_create, "dev", 1U));
    if (write(fd, kNumbers.data(), kNumbers.size()) < 0) return -1;
    lseek(fd, 0, SEEK_SET);
    return fd;
}

int open_any(const char* path, int flags, unsigned mode) {
    if (Chip* chip = Kernel::instance().chip_at(path)) return Kernel::instance().open_chip(*chip);
    if (is_of_ours(path)) return open_numbers();
    return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

int stat_any(const char* path, struct stat* out, int flags) {
    const auto result = static_cast<int>(syscall(SYS_newfstatat, AT_FDCWD, path, out, flags));
    if (result == 0 && Kernel::instance().chip_at(path)) {
        out->st_mode = S_IFCHR | 0660;
        out->st_rdev = makedev(kMajor, 0);
    }
    return result;
}

}  // namespace

extern "C" {

int eddy_open(const char* path, int flags, ...) __asm__("open");
int eddy_open64(const char* path, int flags, ...) __asm__("open64");
int eddy_open_2(const char* path, int flags) __asm__("__open_2");
int eddy_close(int fd) __asm__("close");
int eddy_ioctl(int fd, unsigned long request, ...) __asm__("ioctl");
int eddy_access(const char* path, int mode) __asm__("access");
int eddy_stat(const char* path, struct stat* out) __asm__("stat");
int eddy_lstat(const char* path, struct stat* out) __asm__("lstat");
char* eddy_realpath(const char* path, char* resolved) __asm__("realpath");

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

int eddy_close(int fd) {
    if (!Kernel::instance().is_open(fd)) return static_cast<int>(syscall(SYS_close, fd));
    Kernel::instance().close(fd);
    return 0;
}

int eddy_ioctl(int fd, unsigned long request, ...) {
    va_list rest;
    va_start(rest, request);
    void* argument = va_arg(rest, void*);
    va_end(rest);
    // The kernel looks at 32 bits; some libraries keep them in an int, which is negative here.
    if (Kernel::instance().is_open(fd))
        return Kernel::instance().ioctl(fd, static_cast<std::uint32_t>(request), argument);
    return static_cast<int>(syscall(SYS_ioctl, fd, request, argument));
}

int eddy_access(const char* path, int mode) {
    if (is_of_ours(path)) return 0;
    return static_cast<int>(syscall(SYS_faccessat, AT_FDCWD, path, mode));
}
int eddy_stat(const char* path, struct stat* out) {
    return stat_any(path, out, 0);
}
int eddy_lstat(const char* path, struct stat* out) {
    return stat_any(path, out, AT_SYMLINK_NOFOLLOW);
}

char* eddy_realpath(const char* path, char* resolved) {
    if (std::string_view(path).starts_with(kSubsystemOf)) return strdup("/sys/bus/gpio");
    using Real = char* (*)(const char*, char*);
    static const Real real = reinterpret_cast<Real>(dlsym(RTLD_NEXT, "realpath"));
    return real(path, resolved);
}

}  // extern "C"
