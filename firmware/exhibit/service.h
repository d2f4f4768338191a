#pragma once
#include <string>

#include "firmware/exhibit/heartbeats.h"
#include "firmware/exhibit/service_notify.h"

namespace eddy {

/// The life of the service as its manager is told of it: starting, ready with the first frame, alive, at an end. One thread, the
/// one that draws.
class Service {
  public:
    /// Asked for while the program prepares: some drivers take minutes for a shader, and nothing can be said meanwhile.
    static constexpr Seconds kPreparation{180.0};

    /// `period`: the manager's patience, if it has one. `notify` must outlive this.
    Service(ServiceNotify& notify, std::optional<Seconds> period) : notify_(notify), period_(period) {}

    Heartbeats& heartbeats() { return heartbeats_; }

    /// Before each piece of what comes before the first frame.
    void preparing(Instant now, std::string_view what);
    /// The first frame is on the screen, or would be if there were one: ready.
    void first_frame(Instant now);
    /// At least a few times a second from then on: the watchdog is fed while no part hangs that needs a restart.
    void go_on(Instant now);
    /// What people read in systemctl status; sent when it is another, once a second at most.
    void say(Instant now, std::string_view line);
    /// Around work of this thread that may take long, as often as one likes: a scene that is made, a shader that is compiled beside the
    /// show.
    void long_work_begins();
    void long_work_ends(Instant now);
    /// The settings are read anew; first_frame() is the end of it.
    void reloading() { notify_.reloading(); }
    void stopping();

  private:
    ServiceNotify& notify_;
    std::optional<Seconds> period_;
    Heartbeats heartbeats_;
    bool ready_ = false, long_work_ = false;
    std::optional<Instant> fed_, extended_, said_at_;
    std::string said_;
};

}  // namespace eddy
