#pragma once
#include <optional>

#include "hal/clock.h"

namespace eddy {

/// What the staff's button has just asked for.
struct ButtonNews {
    bool click = false;     ///< the exhibit begins anew; and the force comes back after a stop
    bool guide = false;     ///< show the guide pages
    bool shutdown = false;  ///< end, and power down
    bool factory = false;   ///< start with the factory's configuration
};

/// One button for everything. Pure: what it says follows from the times and contacts it was told of. A press that somebody
/// has thought better of does nothing: let go between two and three seconds, or, of a shutdown, before ten. Only the letting go
/// shuts down or calls for the factory's configuration, so that a button that is stuck does neither.
class Button {
  public:
    static constexpr Instant kDebounce = std::chrono::milliseconds(20);
    static constexpr Instant kShortestClick = std::chrono::milliseconds(30);
    static constexpr Instant kLongestClick = std::chrono::seconds(2);
    static constexpr Instant kGuide = std::chrono::seconds(3);
    static constexpr Instant kFactory = std::chrono::seconds(5);  ///< held since the start
    static constexpr Instant kShutdown = std::chrono::seconds(10);
    static constexpr Instant kStuck = std::chrono::seconds(60);

    /// How far a press has come, for the lamps.
    enum class Phase { Up, Down, Guide, Shutdown, Factory, Stuck };

    /// Whether the contact is closed at `now`, which never goes back; every 10 ms or so. Nothing: its line is away, which
    /// ends a press without any news.
    ButtonNews see(Instant now, std::optional<bool> closed);

    Phase phase() const { return phase_; }

  private:
    void press_goes_on(Instant held, ButtonNews& news);
    void let_go(Instant held, ButtonNews& news);

    bool seen_ = false;
    bool closed_ = false;      // the contact,
    Instant closed_since_{0};  // since when it is as it is
    bool down_ = false;        // without its bounces
    Instant down_since_{0};
    bool from_start_ = false;  // this press was there before we were
    bool told_ = false;        // of this press: its guide pages
    Phase phase_ = Phase::Up;
};

}  // namespace eddy
