#include "tests/redir/redir_server.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace eddy::redir {
namespace {

using namespace std::chrono_literals;

constexpr Instant kIdleTick = 10ms;
constexpr std::size_t kMostUnsent = 1 << 20;  // then the guest is not listened to until it has read
constexpr std::size_t kLongestCommand = 1000;

std::runtime_error socket_error(const std::string& path) {
    return std::runtime_error(fmt::format("cannot listen on {}: {}", path, std::strerror(errno)));
}

int listen_on(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof(address.sun_path)) {
        errno = ENAMETOOLONG;
        throw socket_error(path);
    }
    path.copy(address.sun_path, path.size());
    const auto* plain = reinterpret_cast<const sockaddr*>(&address);
    const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    // A socket without a program behind it is in nobody's use.
    if (connect(fd, plain, sizeof(address)) != 0 && errno == ECONNREFUSED) unlink(path.c_str());
    if (bind(fd, plain, sizeof(address)) == 0 && listen(fd, 4) == 0) return fd;
    const auto error = socket_error(path);
    close(fd);
    throw error;
}

}  // namespace

RedirServer::RedirServer(LivePeer& peer, std::string socket, EventLog& log)
    : peer_(peer), socket_(std::move(socket)), log_(log), listener_(listen_on(socket_)) {}

RedirServer::~RedirServer() {
    host_.reset();
    if (guest_ >= 0) close(guest_);
    close(listener_);
    unlink(socket_.c_str());
}

void RedirServer::run(int commands_fd) {
    commands_ = commands_fd;
    prctl(PR_SET_TIMERSLACK, 1000);  // [ns] the kernel's habit of waking 50 us late would add up
    log_.write(clock_.now(), "listening", {{"socket", socket_}});
    while (!stopped_) {
        const bool to_send = !unsent_.empty();
        const bool to_hear = unsent_.size() < kMostUnsent;
        std::array<pollfd, 3> files{
            {{commands_, POLLIN, 0},
             {guest_ < 0 ? listener_ : -1, POLLIN, 0},
             {guest_, static_cast<short>((to_hear ? POLLIN : 0) | (to_send ? POLLOUT : 0)), 0}}};
        const Instant wait = host_ && host_->busy() ? std::min(peer_.tick(), kIdleTick) : kIdleTick;
        const timespec at_most{0, static_cast<long>(wait.count())};
        ppoll(files.data(), files.size(), &at_most, nullptr);

        const Instant now = clock_.now();
        if (files[0].revents != 0) take_commands(now);
        if (files[1].revents != 0) take_guest(now);
        if (guest_ >= 0 && (files[2].revents & (POLLIN | POLLHUP | POLLERR)) != 0) serve_guest(now);
        if (host_)
            host_->poll(now);
        else
            peer_.poll(now);
        send();
        if (const bool attached = host_ && host_->attached(); std::exchange(attached_, attached) != attached)
            log_.write(now, attached ? "attached" : "detached");
        peer_.report(now, log_);
    }
}

void RedirServer::take_commands(Instant now) {
    std::array<char, 512> bytes{};
    const auto size = read(commands_, bytes.data(), bytes.size());
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) {
        commands_ = -1;  // nobody is left to command; the device goes on
        return;
    }
    command_.append(bytes.data(), static_cast<std::size_t>(size));
    for (std::size_t end = 0; (end = command_.find('\n')) != std::string::npos; command_.erase(0, end + 1))
        obey(now, std::string_view(command_).substr(0, end));
    if (command_.size() > kLongestCommand) command_.clear();
}

void RedirServer::obey(Instant now, std::string_view line) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    if (line.empty()) return;
    std::string wrong;
    if (line == "unplug") {
        plugged_in_ = false;
        if (host_) host_->unplug();
    } else if (line == "plug") {
        plugged_in_ = true;
        if (host_) host_->plug_in();
    } else if (line == "cut") {
        lose_guest(now, "cut");
    } else if (line == "quit") {
        stopped_ = true;
    } else {
        wrong = peer_.command(now, line);
    }
    log_.write(now, "command", {{"line", line}, {"answer", wrong.empty() ? "ok" : wrong}});
}

void RedirServer::take_guest(Instant now) {
    guest_ = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (guest_ < 0) return;
    unsent_.clear();
    host_ = std::make_unique<RedirHost>(peer_, plugged_in_);
    log_.write(now, "connected");
}

void RedirServer::serve_guest(Instant now) {
    std::array<std::uint8_t, 16384> bytes{};
    const auto size = recv(guest_, bytes.data(), bytes.size(), 0);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) return lose_guest(now, "closed by the guest");
    if (!host_->receive({bytes.data(), static_cast<std::size_t>(size)})) lose_guest(now, host_->complaint());
}

void RedirServer::lose_guest(Instant now, const std::string& why) {
    if (guest_ < 0) return;
    log_.write(now, "disconnected", {{"why", why}});
    host_.reset();
    close(std::exchange(guest_, -1));
    unsent_.clear();
}

void RedirServer::send() {
    if (!host_) return;
    const auto output = host_->take_output();
    unsent_.insert(unsent_.end(), output.begin(), output.end());
    if (unsent_.empty()) return;
    const auto sent = ::send(guest_, unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
    if (sent > 0) unsent_.erase(unsent_.begin(), unsent_.begin() + sent);
}

}  // namespace eddy::redir
