#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <string_view>

#include "hal/clock.h"
#include "tests/redir/event_log.h"
#include "tests/redir/redir_host.h"

namespace eddy::redir {

/// A device with people around it, who do what they are told.
class LivePeer : public UsbPeer {
  public:
    /// A line from whoever runs the test. Empty: done; else what is wrong with it.
    virtual std::string command(Instant now, std::string_view line) = 0;
    /// Says what there is to say, now and then.
    virtual void report(Instant now, EventLog& log) = 0;
    /// While a guest waits for it, its time goes on so often at least. What is asked of it is heard at once in any case.
    virtual Instant tick() const = 0;
};

/// Serves one device on a unix socket, to one guest after the other, in real time. Commands of its own, one a line on
/// standard input: `unplug` and `plug` (the guest is told, the connection stays), `cut` (closes the connection),
/// `quit`; all others are the device's.
class RedirServer {
  public:
    /// Throws std::runtime_error if the socket cannot be had; one that a dead program left behind is replaced.
    RedirServer(LivePeer& peer, std::string socket, EventLog& log);
    ~RedirServer();
    RedirServer(const RedirServer&) = delete;
    RedirServer& operator=(const RedirServer&) = delete;

    /// Until `quit`, or until stop() is called.
    void run(int commands_fd);
    /// From a signal handler or another thread.
    void stop() { stopped_ = true; }

  private:
    void take_commands(Instant now);
    void obey(Instant now, std::string_view line);
    void take_guest(Instant now);
    void serve_guest(Instant now);
    void lose_guest(Instant now, const std::string& why);
    void send();

    LivePeer& peer_;
    const std::string socket_;
    EventLog& log_;
    RealClock clock_;
    std::atomic<bool> stopped_{false};
    int listener_ = -1;
    int commands_ = -1;
    std::string command_;  // begun
    int guest_ = -1;
    std::unique_ptr<RedirHost> host_;  // while there is a guest
    std::vector<std::uint8_t> unsent_;
    bool plugged_in_ = true;
    bool attached_ = false;  // as last reported
};

}  // namespace eddy::redir
