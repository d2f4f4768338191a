#include "firmware/haptic_study/rig.h"

#include <cmath>

namespace eddy::haptic_study {

Play play(StudyFluid& fluid, Handle& handle, const Order& order) {
    Play play{.ticks = {}, .answers = {}, .orders = fluid.orders(), .report = {}};
    fluid.exchange.orders.publish(play.orders);
    TickTrace trace(2);
    HapticLoop loop(handle, fluid.exchange, trace, {.law = order.law, .filter = {}, .gate = {}});
    TickRecord tick;
    const double period_s = 1.0 / order.rate_hz;
    long updates = 0;
    Instant last{0};
    for (Instant now{0}; Seconds(now) < order.duration; now += kTick) {
        if (order.let_go && now >= *order.let_go) handle.let_go();
        loop.tick(now);
        trace.drain({&tick, 1});
        play.ticks.push_back({handle.position_m(), tick.sent_force_n});
        const Instant due =
            std::chrono::duration_cast<Instant>(Seconds(period_s * static_cast<double>(updates + 1)));
        if (now + kTick <= due) continue;
        fluid.publish();
        if (updates > 0) play.answers.push_back(fluid.exchange.fluid.newest());
        fluid.update(due, due - last);
        last = due;
        ++updates;
    }
    play.report = fluid.exchange.report.newest();
    return play;
}

}  // namespace eddy::haptic_study
