#include "firmware/verbs/stepped_run.h"

#include <fmt/format.h>

#include "config/scene.h"
#include "firmware/destination.h"
#include "firmware/exhibit/caption.h"
#include "firmware/exhibit/playbill.h"
#include "firmware/graphics.h"
#include "firmware/progress.h"
#include "firmware/recording.h"
#include "firmware/run_summary.h"
#include "firmware/status.h"
#include "firmware/text_file.h"
#include "firmware/verbs/run_device.h"
#include "firmware/verbs/run_options.h"
#include "firmware/verbs/stop.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

}  // namespace

int run_stepped(const RunOptions& options) {
    const Exhibit exhibit = with_options(load_exhibit(options.config).exhibit, options);
    const Scene scene = load_scene(exhibit.scene, options.set).scene;
    require_possible(options, exhibit, scene);
    for (const SolverPreset preset : exhibit.presets) {  // each must be able to do what the scene asks for
        std::vector<std::string> set = options.set;
        set.push_back(fmt::format("solver.preset=\"{}\"", to_word(preset)));
        load_scene(exhibit.scene, set);
    }
    RunDevice device = make_device(options, exhibit);
    prepare_folders(options);
    if (!options.record.empty()) prepare_folder("--record", options.record);

    HandSide hand(std::move(device.device), std::move(device.name), loop_settings(exhibit),
                  flights_folder(exhibit));
    hand.orders().set_ceiling(exhibit.max_force_n);
    const std::unique_ptr<Graphics> graphics = open_headless();
    Recording recording;
    recording.begin(options.record);
    Playbill playbill(graphics->gpu, hand);
    playbill.announce(scene, act_setup(options, exhibit, scene, recording.on(), hand.has_device()));
    std::optional<Playbill::News> news;
    while (!news) news = playbill.work();
    if (!news->began) throw gles::GlError(news->failed);

    Act& act = playbill.act();
    SteppedClock clock;
    const RealClock wall;
    Progress progress("run");
    const auto report = [&](Instant now) {
        act.adjust_gain(hand.report());
        for (const std::string& line : act.news()) fmt::print(stderr, "run: {}\n", line);
        act.release_latch(now, hand.report());
        progress.show(Seconds(now).count(), *options.seconds,
                      fmt::format("{} fluid steps", act.show().figures().steps));
    };
    const auto follow = [&] {
        hand.follow([&](std::span<const TickRecord> ticks) { recording.add(ticks); });
    };

    const Instant period = instant(Seconds(scene.solver.dt_s));
    const Instant frame_period = instant(Seconds(1.0 / options.frames_per_s));
    Instant fluid_due = period, frame_due{0};
    const Instant end = instant(Seconds(*options.seconds));
    for (Instant t{0}; !asked_to_stop() && t < end; t += kTick) {
        clock.sleep_until(t);
        hand.tick(clock.now());
        if (t + kTick < fluid_due) continue;
        act.publish(act.show().figures().steps > 0);
        act.go_on(fluid_due, Seconds(period));
        if (recording.on() && fluid_due >= frame_due) {
            recording.add(graphics->gpu, act.draw(fluid_due, caption_of(hand)).picture());
            frame_due += frame_period;
        }
        fluid_due += period;
        follow();
        report(t);
    }
    hand.end();
    follow();
    act.publish(true);
    const Instant now = clock.now();
    report(now);
    progress.finish();
    recording.finish();
    hand.finish_flights();
    if (const auto flight = hand.flight_news()) fmt::print(stderr, "run: {}\n", *flight);
    if (is_folder(exhibit.run_dir)) {
        Status status = status_of(act, *graphics, hand);
        status.uptime_s = Seconds(now).count();
        write_status(exhibit.run_dir / "status.json", status);
    }
    print_summary({"stepped", Seconds(now).count(), Seconds(now).count(), Seconds(wall.now()).count()}, act,
                  *graphics, hand, recording.recorder());
    return recording.failed() ? 1 : 0;
}

}  // namespace eddy
