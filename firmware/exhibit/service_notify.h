#pragma once
#include <sys/un.h>

#include <optional>
#include <string>
#include <string_view>

#include "hal/clock.h"

namespace eddy {

/// What the program tells the service manager that started it, over the socket it was given: systemd's notify protocol, one
/// datagram a message. Never waits: a manager that does not read loses messages. Where there is no manager, nothing happens. Any
/// one thread.
class ServiceNotify {
  public:
    /// `socket`: as NOTIFY_SOCKET has it, a path, or a name that begins with @; empty: nobody listens.
    explicit ServiceNotify(std::string_view socket);
    /// That of this process, which its children do not get.
    static ServiceNotify from_environment();
    ~ServiceNotify();
    ServiceNotify(ServiceNotify&& other) noexcept;
    ServiceNotify& operator=(ServiceNotify&&) = delete;

    bool listened_to() const { return fd_ >= 0; }

    // False if the message did not get through.
    bool ready();
    /// One line for people.
    bool status(std::string_view line);
    bool watchdog();
    /// From now on the watchdog is content with so long a silence.
    bool set_watchdog(Seconds silence);
    bool stopping();
    /// To be followed by ready().
    bool reloading();
    /// The start may take so much longer from now on.
    bool extend_start(Seconds longer);

  private:
    bool send(std::string_view message);

    int fd_ = -1;
    sockaddr_un address_{};
    unsigned length_ = 0;
};

/// How long the service manager bears with silence before it ends the program; none: for ever. `usec` and `pid` as WATCHDOG_USEC
/// and WATCHDOG_PID have them, null if they are not there.
std::optional<Seconds> watchdog_period(const char* usec, const char* pid, int own_pid);
/// That of this process.
std::optional<Seconds> watchdog_period();

}  // namespace eddy
