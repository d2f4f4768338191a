#include "firmware/run_summary.h"

#include <fmt/format.h>

namespace eddy {

Status status_of(const Act& act, const Graphics& graphics, const HandSide& hand) {
    const GainWatch& gain = act.gain();
    return {.scene = act.scene().title,
            .renderer = graphics.gpu.capabilities().renderer,
            .display = graphics.display->describe(),
            .haptic_device = hand.name(),
            .show = act.show().figures(),
            .guards = act.show().guards(),
            .loop = hand.report(),
            .cost = act.cost(),
            .gain = {gain.gain(), act.scene().haptics.gain, gain.changes()},
            .flights = hand.flights_kept()};
}

void print_summary(const RunLength& length, const Act& act, const Graphics& graphics, const HandSide& hand,
                   const Recorder* recorder) {
    const ShowFigures& f = act.show().figures();
    const LoopReport& loop = hand.report();
    const auto print_stages = [&] {
        std::string text;
        for (const std::string& stage : act.stopwatch().stages())
            text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", stage,
                                median(act.stopwatch().of(stage).wall_ms));
        return text;
    };
    const gles::FluidSetup& fluid = act.show().fluid().setup();
    fmt::print("scene       {} ({}x{}x{} cells of {:.2f} mm)\n", act.scene().title, fluid.cells.x,
               fluid.cells.y, fluid.cells.z, fluid.cell_m * 1e3);
    fmt::print("renderer    {}, {}\n", graphics.gpu.capabilities().renderer, graphics.display->describe());
    fmt::print("hand        {}\n", hand.name());
    fmt::print("fluid       {} steps in {:.1f} s of {} clock: {:.1f} steps/s\n", f.steps, length.show_s,
               length.clock, static_cast<double>(f.steps) / length.wall_s);
    fmt::print("ms a stage  {} (wall, median of one step in {})\n", print_stages(), kMeasureEvery);
    fmt::print("divergence  {:.3g} 1/s before the projection, {:.3g} 1/s after it ({:.0f}-fold)\n",
               f.divergence_before_1_s, f.divergence_after_1_s,
               f.divergence_after_1_s > 0.0 ? f.divergence_before_1_s / f.divergence_after_1_s : 0.0);
    fmt::print("force       {:.3g} to {:.3g} N from the fluid after gain, at most {:.3g} N sent\n",
               f.least_force_n.value_or(0.0), f.most_force_n, hand.sent_most_n());
    fmt::print("haptic loop {} ticks in {:.1f} s: {:.0f} Hz; {} late, {} left out, worst {:.2f} ms\n",
               loop.ticks, length.hand_s,
               length.hand_s > 0.0 ? static_cast<double>(loop.ticks) / length.hand_s : 0.0, loop.late,
               loop.missed, Seconds(loop.worst_late).count() * 1e3);
    fmt::print("gate        {}; clamped {}, slewed {}, not finite {}\n", to_string(loop.reason),
               loop.gate.clamped, loop.gate.slewed, loop.gate.non_finite);
    if (recorder)
        fmt::print("recorded    {} pictures, force.csv{} in {}\n", recorder->frames(),
                   recorder->plotted() ? " and motion.png" : "", recorder->folder().string());
    else
        fmt::print("recorded    nothing (--record DIR keeps pictures and forces)\n");
}

}  // namespace eddy
