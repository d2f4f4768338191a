#pragma once
#include <array>
#include <atomic>
#include <mutex>

#include "firmware/exhibit/button.h"
#include "firmware/exhibit/panel.h"
#include "firmware/exhibit/stop_memory.h"
#include "firmware/haptic/stop_input.h"
#include "hal/gpio/kept_line.h"

namespace eddy {

/// What the panel's thread does, without the thread: on any clock. work() belongs to one thread, the rest to all.
class PanelWork {
  public:
    /// A stop input counts as let go when it has been for so long without a break.
    static constexpr Instant kStopRests = std::chrono::milliseconds(20);

    /// `gpio` must outlive it. Without a stop input stop_input() is never pressed; else it is until work() has found its line let go.
    /// `stop_file`: of StopMemory.
    PanelWork(Gpio& gpio, const GpioConfig& config, const std::filesystem::path& stop_file = {});

    /// Looks at the inputs and drives the lamps. Every Panel::kPeriod, and when there are edges.
    void work(Instant now);
    /// All lamps off.
    void darken(Instant now);
    /// Whether the stop input is not wired or its line is there.
    bool stop_is_known() const { return !stop_.wanted() || stop_seen_; }
    /// The run before this one ended while it was pressed, or before somebody clicked.
    bool stop_was_held() const { return stop_.wanted() && stop_memory_.held(); }
    /// Of the button and of the stop input; -1: none.
    std::array<int, 2> edges_fds() const { return {button_line_.edges_fd(), stop_.edges_fd()}; }

    void show(LampCode code) { asked_.store(code, std::memory_order_relaxed); }
    PanelNews news();
    const StopInput& stop_input() const { return stop_input_; }
    HandleLight handle_light() const;
    std::uint64_t beats() const { return beats_.load(std::memory_order_relaxed); }

  private:
    void see_stop(Instant now);
    void see_button(Instant now);
    LampCode code_now() const;
    void light(Instant now);
    void tell();

    KeptLine button_line_, stop_, green_, amber_, red_;
    Button button_;
    LampPlayer player_;
    std::atomic<bool> stop_seen_{false};
    bool stopped_;
    Instant stop_pressed_at_{0};  // last seen so
    StopMemory stop_memory_;

    std::atomic<LampCode> asked_{LampCode::Starting};
    StopInput stop_input_;
    std::atomic<std::uint64_t> beats_{0};
    mutable std::mutex mutex_;
    // With the mutex held:
    PanelNews news_;
    HandleLight ring_;
};

}  // namespace eddy
