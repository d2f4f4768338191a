#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "loop_rig.h"

// What must take the force away, seen from outside: a loop whose device has 4 N on its motors, and the command of the very tick in
// which the loop is told.

namespace eddy {
namespace {

using namespace std::chrono_literals;

struct Condition {
    std::string name;
    GateReason reason;
    std::function<void(LoopRig&)> happen;
};

const std::vector<Condition>& conditions() {
    static const std::vector<Condition> all{
        {"the stop input", GateReason::Stopped, [](LoopRig& r) { r.orders.stop = true, r.order(); }},
        {"the stop input that the loop itself looks at", GateReason::Stopped,
         [](LoopRig& r) { r.stop_input.found(true, r.now()); }},
        {"nobody has looked at the stop input for half a second", GateReason::Stopped,
         [](LoopRig& r) {
             r.stop_input.found(false, r.now());
             r.run(500);
             EXPECT_GT(glm::length(r.device.commanded_n), 4.0) << "a look counts for so long";
         }},
        {"pause, scene change, fluid reset", GateReason::Disabled,
         [](LoopRig& r) { r.orders.enabled = false, r.order(); }},
        {"a force that is no number", GateReason::NotFinite,
         [](LoopRig& r) {
             r.fluid.force_n.x = std::numeric_limits<double>::quiet_NaN();
             ++r.fluid.sequence;
             r.exchange.fluid.publish(r.fluid);
         }},
        {"a position that is no number", GateReason::NotFinite,
         [](LoopRig& r) {
             r.device.path = [](Seconds) { return glm::dvec3(std::numeric_limits<double>::infinity()); };
         }},
        {"the plug is pulled", GateReason::DeviceNotReady,
         [](LoopRig& r) { r.device.is = HapticState::Absent, r.device.answers = false; }},
        {"homing is lost", GateReason::DeviceNotReady, [](LoopRig& r) { r.device.is = HapticState::Homing; }},
        {"the driver gave up", GateReason::DeviceNotReady,
         [](LoopRig& r) { r.device.is = HapticState::Fault; }},
        {"no reply for 20 ms", GateReason::DeviceSilent,
         [](LoopRig& r) {
             r.device.answers = false;
             r.run(19);
         }},
        {"the device is not sure where the handle is, for longer than a moment", GateReason::DeviceUnsure,
         [](LoopRig& r) {
             r.device.sure = false;
             r.tick();
             EXPECT_EQ(r.device.commanded_n, glm::dvec3(0.0)) << "at once, too";
             r.run(100);
         }},
        {"faster than a hand", GateReason::TooFast,
         [](LoopRig& r) {
             const Instant start = r.now();
             r.device.path = [start](Seconds t) {
                 return glm::dvec3(0.0, 1.5 * (t - Seconds(start)).count(), 0.0);
             };
             while (glm::length(r.exchange.pose.newest().velocity_m_s) <= 1.0 &&
                    r.report().reason != GateReason::TooFast)
                 r.tick();
         }},
        {"nobody holds it", GateReason::Released,
         [](LoopRig& r) {
             r.device.path = [](Seconds) { return glm::dvec3(0.02); };
             r.run(5000);
         }},
    };
    return all;
}

TEST(Safety, EachConditionTakesTheWholeForceAwayInTheTickThatKnowsOfIt) {
    for (const Condition& condition : conditions()) {
        SCOPED_TRACE(condition.name);
        LoopRig rig;
        rig.run(2000);
        ASSERT_GT(glm::length(rig.device.commanded_n), 4.0);
        condition.happen(rig);
        rig.tick();
        EXPECT_EQ(rig.device.commanded_n, glm::dvec3(0.0));
        EXPECT_EQ(rig.report().reason, condition.reason);
    }
}

TEST(Safety, AfterEachTheForceComesBackSoftlyOrNotAtAll) {
    for (const Condition& condition : conditions()) {
        SCOPED_TRACE(condition.name);
        LoopRig rig;
        rig.run(2000);
        const auto path = rig.device.path;
        condition.happen(rig);
        rig.tick();
        // All is well again, and an attendant says so.
        rig.device.path = path;
        rig.device.is = HapticState::Ready;
        rig.device.answers = true;
        rig.device.sure = true;
        rig.fluid.force_n = {0.0, 5.0, 0.0};
        rig.run(20);  // the fluid's next answer
        rig.orders.enabled = true;
        rig.orders.stop = false;
        rig.stop_input.found(false, rig.now() + 10s);
        ++rig.orders.resets;
        ++rig.orders.restarts;
        rig.order();
        glm::dvec3 last = rig.device.commanded_n;
        double most = 0.0;
        for (int i = 0; i < 1500; ++i) {
            rig.tick();
            most = std::max(most, glm::length(rig.device.commanded_n - last));
            last = rig.device.commanded_n;
        }
        EXPECT_GT(glm::length(last), 4.0);
        EXPECT_LE(most, 0.020);
    }
}

TEST(Safety, AStopOutlastsTheResetsThatForgiveFaults) {
    LoopRig rig;
    rig.run(2000);
    rig.orders.stop = true;
    rig.order();
    rig.tick();
    rig.orders.stop = false;
    for (int i = 0; i < 100; ++i) {
        ++rig.orders.resets;
        rig.order();
        rig.tick();
        ASSERT_EQ(rig.device.commanded_n, glm::dvec3(0.0));
    }
    EXPECT_EQ(rig.report().reason, GateReason::Stopped);
}

TEST(Safety, WhateverGainAndForceNoMoreThanTheLimitIsSent) {
    for (const double gain : {1.0, 50.0, -50.0, 1e6, 1e300}) {
        LoopRig rig;
        rig.orders.gain = gain;
        rig.order();
        for (int i = 0; i < 3000; ++i) {
            rig.fluid.force_n = 40.0 * glm::dvec3(std::sin(0.01 * i), std::cos(0.013 * i), 1.0);
            rig.tick();
            ASSERT_LE(glm::length(rig.device.commanded_n), kDeviceMaxForceN * (1.0 + 1e-15));
        }
    }
}

}  // namespace
}  // namespace eddy
