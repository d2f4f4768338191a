#pragma once
#include <cstdint>

#include "hal/clock.h"

namespace eddy {

/// Who is at the exhibit, as far as its handle tells: nobody, somebody, or somebody who seems to have gone.
enum class Presence : std::uint8_t { Nobody, Here, Leaving };

/// Follows visitors by when the handle was last touched (RestWatch::untouched). One who has not touched it for some time is warned,
/// then counted as gone: the exhibit is to be as it was, exactly, and to attract others. Virtual time.
class Visitors {
  public:
    /// The warning comes so long before, or in the last half of a short time.
    static constexpr Seconds kWarning{10.0};

    /// `idle_after`: without a touch, until a visitor counts as gone.
    explicit Visitors(Seconds idle_after) : idle_after_(idle_after) {}

    /// What has happened since the last look.
    struct News {
        bool came = false;   ///< a new visitor
        bool gone = false;   ///< back to the start of the scene, and attract
        Seconds dwell{0.0};  ///< of the one who is gone: from the first touch to the last
    };
    /// `untouched`: since the handle was touched; it may go back (a new scene knows of no touch yet).
    News see(Instant now, Instant untouched);
    /// In its place while it is closed: who touches the handle then is no visitor.
    void closed(Instant now) { last_touch_ = now; }

    Presence presence() const { return presence_; }
    /// Counts that live: takes effect with the next look.
    void set_idle_after(Seconds idle_after) { idle_after_ = idle_after; }

  private:
    Seconds idle_after_;
    Presence presence_ = Presence::Nobody;
    Instant first_touch_{0}, last_touch_{0};
};

}  // namespace eddy
