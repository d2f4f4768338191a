#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "config/exhibit.h"
#include "firmware/exhibit/lamps.h"
#include "firmware/haptic/stop_input.h"
#include "hal/gpio/gpio.h"

namespace eddy {

/// What has happened on the panel since the last time somebody asked, and how it is now.
struct PanelNews {
    std::uint64_t resets = 0;  ///< clicks: the exhibit begins anew
    bool force_back = false;   ///< one of them came after the last stop was let go: HandOrders::restart()
    bool guide = false;        ///< show the guide pages
    bool shutdown = false;     ///< end, and power down
    bool factory = false;      ///< held since the start: start with the factory's configuration

    // Now:
    bool button_stuck = false;  ///< for more than a minute; it is ignored
    std::string
        trouble{};  ///< of lines that are away, a sentence each, with line ends between; empty: all is well
};

/// Button, stop input and lamps of the exhibit, on a thread of their own. What of them is not wired (an empty address in the
/// configuration) is left out; a line that goes away is taken back when it returns: meanwhile the button counts as let go, the
/// stop input as pressed.
class Panel {
  public:
    /// The stop input and the button are looked at so often, whatever edges their chip tells of: drivers of USB bridges find these
    /// later by themselves, and a line that is gone tells none.
    static constexpr Instant kPeriod = std::chrono::milliseconds(10);
    /// A USB bridge may come up well after the program does. So long a stop input that is not there is waited for, with no hand, before
    /// it counts as pressed, so that the day does not begin with a stop.
    static constexpr Instant kPatience = std::chrono::seconds(60);

    /// `gpio` and `clock` must outlive it. Throws nothing but for want of memory or threads: what cannot be had is told in
    /// news().trouble. Waits for no line: a bridge may hang. `stop_file`: where a stop is remembered (stop_memory.h).
    Panel(Gpio& gpio, const GpioConfig& config, const Clock& clock,
          const std::filesystem::path& stop_file = {}, Instant patience = kPatience);
    /// All lamps are dark then.
    ~Panel();
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;

    // Any thread:

    /// From now on, until something else is said. While the stop input is pressed, or the button held for long, the lamps say
    /// that; when it is over, this again.
    void show(LampCode code);
    /// Once: what happened since the last call is forgotten.
    PanelNews news();
    /// From then on stop_input() is true to what its line says, or nobody waits for the line any longer.
    bool settled() const;
    /// The run before this one ended while the stop was pressed, or before somebody clicked: HandOrders::stay_stopped().
    bool stop_was_held() const;
    /// For HapticLoop, which must not begin before settled(), on the same clock. Never pressed where there is no stop input.
    const StopInput& stop_input() const;
    /// For HapticExchange::light, of the code that is shown now.
    HandleLight handle_light() const;
    /// Counts on, a hundred times a second or more, while all is well with this thread.
    std::uint64_t beats() const;

  private:
    class Thread;
    std::unique_ptr<Thread> thread_;
};

}  // namespace eddy
