#include "firmware/exhibit/service_notify.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace eddy {
namespace {

std::string one_line(std::string_view text) {
    std::string line(text);
    for (char& c : line)
        if (c == '\n' || c == '\r') c = ' ';
    return line;
}

long long usec_of(Seconds seconds) {
    return std::chrono::duration_cast<std::chrono::microseconds>(seconds).count();
}

template <class T>
std::optional<T> number_in(std::string_view text) {
    T number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace

ServiceNotify::ServiceNotify(std::string_view socket) {
    const bool usable = socket.starts_with('/') || socket.starts_with('@');
    if (!usable || socket.size() < 2 || socket.size() >= sizeof(address_.sun_path)) return;
    address_.sun_family = AF_UNIX;
    std::memcpy(address_.sun_path, socket.data(), socket.size());
    if (socket.front() == '@') address_.sun_path[0] = '\0';  // a name that is in no folder
    length_ = static_cast<unsigned>(offsetof(sockaddr_un, sun_path) + socket.size());
    fd_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
}

ServiceNotify ServiceNotify::from_environment() {
    const char* socket = std::getenv("NOTIFY_SOCKET");
    ServiceNotify notify(socket ? std::string_view(socket) : std::string_view());
    ::unsetenv("NOTIFY_SOCKET");
    return notify;
}

ServiceNotify::~ServiceNotify() {
    if (fd_ >= 0) ::close(fd_);
}

ServiceNotify::ServiceNotify(ServiceNotify&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), address_(other.address_), length_(other.length_) {}

bool ServiceNotify::send(std::string_view message) {
    if (fd_ < 0) return false;
    const ssize_t sent = ::sendto(fd_, message.data(), message.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                                  reinterpret_cast<const sockaddr*>(&address_), length_);
    return sent == static_cast<ssize_t>(message.size());
}

bool ServiceNotify::ready() {
    return send("READY=1");
}

bool ServiceNotify::status(std::string_view line) {
    return send("STATUS=" + one_line(line));
}

bool ServiceNotify::watchdog() {
    return send("WATCHDOG=1");
}

bool ServiceNotify::set_watchdog(Seconds silence) {
    return send(fmt::format("WATCHDOG_USEC={}", usec_of(silence)));
}

bool ServiceNotify::stopping() {
    return send("STOPPING=1");
}

bool ServiceNotify::reloading() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    const long long usec = static_cast<long long>(now.tv_sec) * 1'000'000 + now.tv_nsec / 1000;
    return send(fmt::format("RELOADING=1\nMONOTONIC_USEC={}", usec));
}

bool ServiceNotify::extend_start(Seconds longer) {
    return send(fmt::format("EXTEND_TIMEOUT_USEC={}", usec_of(longer)));
}

std::optional<Seconds> watchdog_period(const char* usec, const char* pid, int own_pid) {
    if (!usec || (pid && number_in<int>(pid) != own_pid)) return std::nullopt;
    const auto period = number_in<long long>(usec);
    if (!period || *period <= 0) return std::nullopt;
    return std::chrono::microseconds(*period);
}

std::optional<Seconds> watchdog_period() {
    return watchdog_period(std::getenv("WATCHDOG_USEC"), std::getenv("WATCHDOG_PID"), ::getpid());
}

}  // namespace eddy
