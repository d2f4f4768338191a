#include "firmware/stability/hand_fuzz.h"

#include <algorithm>
#include <limits>

#include "firmware/stability/random_hand.h"
#include "firmware/stability/rule.h"
#include "firmware/stability/stepped_exhibit.h"

namespace eddy::stability {
namespace {

/// What eddy run asks of a show in one update.
constexpr Instant kLongestUpdate = std::chrono::milliseconds(100);
/// Updates between looks into the fields.
constexpr long kBetweenLooks = 10;

Instant nanoseconds(double seconds) {
    return std::chrono::duration_cast<Instant>(Seconds(seconds));
}

/// All that moves is the hand, and of that anything may come: of the fields only what is no number can be said to be wrong.
Justified anything() {
    constexpr double kAny = std::numeric_limits<double>::infinity();
    return {.speed_m_s = kAny,
            .work_j = kAny,
            .smoke_added = {-kAny, kAny},
            .temperature_added_k = {-kAny, kAny}};
}

}  // namespace

HandFuzzFigures play_random_hand(gles::Gpu& gpu, const Scene& scene, std::uint64_t seed, Seconds duration) {
    Draw draw(~seed);
    RandomHand hand(seed);
    const ForceFilterSettings open{.lowest_cutoff_hz = 500.0, .highest_cutoff_hz = 500.0, .impulse_n = 1e3};
    SteppedExhibit exhibit(gpu, scene, &hand, seed % 2 == 0 ? open : ForceFilterSettings{});
    HapticOrders orders = exhibit.orders();
    orders.gain *= draw.scale(1.0, 1e4);
    exhibit.order(orders);

    const Tank tank = tank_of(exhibit.show().fluid().setup());
    Rule rule(tank, {.most_n = std::min(kDeviceMaxForceN, scene.haptics.max_force_n)});
    rule.begin(download(exhibit.show().fluid()));
    const double period_s = scene.solver.dt_s;
    HandFuzzFigures figures;
    Instant now{0}, felt{0}, updated{0}, due = nanoseconds(period_s);
    RandomHand::Act act = hand.act();
    while (Seconds(now) < duration && !rule.failed()) {
        now += draw.chance(0.002) ? nanoseconds(draw.scale(1e-3, 0.08)) : kTick;
        exhibit.tick(now);
        if (hand.act() != act) {
            act = hand.act();
            orders.enabled = draw.chance(0.9);
            if (draw.chance(0.7)) ++orders.resets;
            exhibit.order(orders);
        }
        if (now < due) continue;
        exhibit.update(now, std::min(now - updated, kLongestUpdate));
        updated = now;
        due = now + nanoseconds(period_s * (draw.chance(0.9) ? 1.0 : draw.scale(0.05, 25.0)));
        for (const TickRecord& tick : exhibit.ticks()) {
            rule.feel(tick.sent_force_n, Seconds(tick.t - felt).count());
            felt = tick.t;
            figures.most_n = std::max(figures.most_n, glm::length(tick.sent_force_n));
            figures.reasons.insert(tick.reason);
            ++figures.ticks;
        }
        if (++figures.steps % kBetweenLooks != 0) continue;
        const Fields fields = download(exhibit.show().fluid());
        rule.see({.step = figures.steps,
                  .time_s = Seconds(now).count(),
                  .justified = anything(),
                  .fields = &fields});
    }
    figures.violation = rule.verdict().reason;
    figures.gate = exhibit.report().gate;
    return figures;
}

}  // namespace eddy::stability
