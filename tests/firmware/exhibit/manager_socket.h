#pragma once
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/scratch_folder.h"

namespace eddy {

/// The end of a datagram socket at which systemd, or its journal, would listen. A name that begins with @ is in no folder.
class ManagerSocket {
  public:
    explicit ManagerSocket(const std::string& name) : fd_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::memcpy(address.sun_path, name.data(), name.size());
        if (name.front() == '@') address.sun_path[0] = '\0';
        const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
        if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), length) != 0)
            throw std::runtime_error(name + ": cannot be bound");
    }
    ~ManagerSocket() { ::close(fd_); }
    ManagerSocket(const ManagerSocket&) = delete;
    ManagerSocket& operator=(const ManagerSocket&) = delete;

    /// What came since the last call.
    std::vector<std::string> messages() {
        std::vector<std::string> all;
        char buffer[65536];
        for (ssize_t got; (got = ::recv(fd_, buffer, sizeof(buffer), MSG_DONTWAIT)) >= 0;)
            all.emplace_back(buffer, static_cast<std::size_t>(got));
        return all;
    }

  private:
    int fd_;
};

}  // namespace eddy
