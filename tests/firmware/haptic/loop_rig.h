#pragma once
#include <cmath>
#include <vector>

#include "firmware/haptic/loop.h"
#include "tests/firmware/haptic/scripted_device.h"

namespace eddy {

/// A loop, a hand that trembles in the middle of its tank, a fluid at 50 Hz that pushes with 5 N, and a flight recorder.
struct LoopRig {
    ScriptedDevice device;
    HapticExchange exchange;
    TickTrace trace{20'000};
    HapticLoopSettings settings{};
    FlightRecorder flights{settings};
    StopInput stop_input{false};
    HapticLoop loop{device, exchange, trace, settings, &flights, &stop_input};
    HapticOrders orders{.enabled = true,
                        .tank_from_device = {.centre_m = glm::dvec3(0.1), .scale = 1.0},
                        .lowest_m = glm::dvec3(0.0),
                        .highest_m = glm::dvec3(0.2)};
    FluidSnapshot fluid{.force_n = {0.0, 5.0, 0.0}, .fluid_period = Seconds(0.020)};
    bool fluid_runs = true;
    std::int64_t ticks = 0;

    LoopRig() {
        device.path = [](Seconds t) { return glm::dvec3(0.0005 * std::sin(60.0 * t.count()), 0.0, 0.0); };
        order();
    }
    void order() { exchange.orders.publish(orders); }
    Instant now() const { return std::chrono::milliseconds(ticks); }
    void tick() {
        ++ticks;
        if (fluid_runs && ticks % 20 == 1) {
            ++fluid.sequence;
            fluid.computed_for = exchange.pose.newest().time;
            exchange.fluid.publish(fluid);
        }
        loop.tick(now());
    }
    void run(int n) {
        for (int i = 0; i < n; ++i) tick();
    }
    const LoopReport& report() { return exchange.report.newest(); }
};

}  // namespace eddy
