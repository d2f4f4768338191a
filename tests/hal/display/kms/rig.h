#pragma once
#include <gtest/gtest.h>

#include <memory>

#include "hal/display/emulated/emulated_machine.h"
#include "hal/display/kms/kms_display.h"

namespace eddy::kms {

/// A display on an emulated machine, and a show that draws a frame whenever one is wanted, sixty times a second.
struct Rig {
    emulated::ScreenMachine machine;
    Wish wish{};
    std::unique_ptr<KmsDisplay> display;
    DisplayState state = DisplayState::NoMonitor;

    emulated::GraphicsCard& card(std::size_t i = 0) const { return machine.card(i); }
    void open() {
        display = std::make_unique<KmsDisplay>(machine.machine(), wish);
        state = display->poll(machine.now());
    }
    /// One turn of the show's loop.
    void turn(Instant dt = std::chrono::microseconds(16667)) {
        machine.wait(dt);
        state = display->poll(machine.now());
        if (display->wants_frame()) display->present();
    }
    void run(Instant time, Instant dt = std::chrono::microseconds(16667)) {
        for (const Instant end = machine.now() + time; machine.now() < end;) turn(dt);
    }
    /// Runs until the state is that one; how long that took, or more than `limit`.
    Instant until(DisplayState wanted, Instant limit) {
        const Instant start = machine.now();
        do turn();
        while (state != wanted && machine.now() - start <= limit);
        return machine.now() - start;
    }
    long flips() const { return display->counters().flips; }
    /// Frames that come onto the screen in the next second.
    long rate() {
        const long before = flips();
        run(std::chrono::seconds(1));
        return flips() - before;
    }
};

}  // namespace eddy::kms
