#include "firmware/haptic_study/report.h"

#include <fmt/format.h>

namespace eddy::haptic_study {
namespace {

std::string ms_of(const std::optional<double>& seconds) {
    return seconds ? fmt::format("{:.0f}", 1e3 * *seconds) : "-";
}

std::string picture(const std::vector<std::filesystem::path>& pictures, const std::string& name,
                    const std::string& says) {
    for (const std::filesystem::path& file : pictures)
        if (file.filename() == name) return fmt::format("\n![{}]({})\n", says, name);
    return "";
}

std::string circle_table(const Study& study) {
    std::string text =
        "| fluid | law | answers/s | force [N] | roughness [%] | trembling [%] | of the reference [%] | rmse "
        "[%] | lag [ms] | half "
        "of the force "
        "after [ms] | drag, mass in the model | damped [%] "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const CircleRow& row : study.circles) {
        const CircleFigures& f = row.figures;
        text += fmt::format(
            "| {} | {} | {:.0f} | {:.3f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.1f} | {} | {} | {:.1f} |\n",
            row.fluid, to_string(row.law), row.rate_hz, f.force_n, 100.0 * f.roughness, 100.0 * f.trembling,
            100.0 * f.reference_trembling, 100.0 * f.rmse, 1e3 * f.lag_s, ms_of(f.half_rise_s),
            row.law == ForceLaw::Model
                ? fmt::format("{:.2f} N s/m, {:.3f} kg", f.report.drag_ns_m, f.report.added_kg)
                : "",
            100.0 * f.damped);
    }
    return text;
}

std::string stir_table(const Study& study) {
    std::string text =
        "| fluid | law | answers/s | stirred [Hz] | cheapest cycle [mJ] | mean cycle [mJ] | received by the "
        "fluid [mJ] | work of such a drag [mJ] "
        "|\n|---|---|---|---|---|---|---|---|\n";
    for (const StirRow& row : study.stirs)
        text += fmt::format("| {} | {} | {:.0f} | {} | {:.3g} | {:.3g} | {:.3g} | {:.3g} |\n", row.fluid,
                            to_string(row.law), row.rate_hz, row.stir_hz, 1e3 * row.figures.least_cycle_j,
                            1e3 * row.figures.mean_cycle_j, 1e3 * row.figures.received_j,
                            1e3 * row.figures.drag_j);
    return text;
}

std::string swing_table(const Study& study) {
    std::string text =
        "| fluid | law | answers/s | handle | force [N] | way [mm] | of the flow: force [N] | way [mm] |\n"
        "|---|---|---|---|---|---|---|---|\n";
    for (const SwingRow& row : study.swings)
        text += fmt::format("| {} | {} | {:.0f} | {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n", row.fluid,
                            to_string(row.law), row.rate_hz, held_how(row), row.swing.force_n,
                            1e3 * row.swing.position_m, row.carried.force_n, 1e3 * row.carried.position_m);
    return text;
}

std::string fluid_table(const Study& study) {
    std::string text = "| scene | its gain | drag [N s/m] | added mass [kg] |";
    for (const double rate_hz : kRatesHz) text += fmt::format(" gain at {:.0f} |", rate_hz);
    text += "\n|---|---|---|---|---|---|---|---|\n";
    for (const FluidRow& row : study.fluids) {
        text +=
            fmt::format("| {} | {:g} | {:.2f} | {:.3f} |", row.fluid, row.gain, row.drag_ns_m, row.added_kg);
        for (const double gain : row.gains) text += fmt::format(" {:.3g} |", gain);
        text += "\n";
    }
    return text;
}

std::string pull_table(const Study& study) {
    std::string text = "| fluid | answers/s | felt is off by, of what the fluid gives |\n|---|---|---|\n";
    for (const PullRow& row : study.pulls)
        text += fmt::format("| {} | {:.0f} | {:.2f} % |\n", row.fluid, row.rate_hz, 100.0 * row.error);
    return text;
}

std::string goal_table(const Study& study) {
    std::string text = "| goal | found | reached |\n|---|---|---|\n";
    for (const Goal& goal : goals_of(study))
        text += fmt::format("| {} | {} | {} |\n", goal.what, goal.found, goal.reached ? "yes" : "**no**");
    return text;
}

}  // namespace

std::string summary_of(const Study& study) {
    std::string text = fmt::format("{:<10}{:<8}{:>10}{:>10}{:>12}{:>9}{:>9}{:>12}\n", "fluid", "law",
                                   "answers/s", "force N", "roughness %", "rmse %", "lag ms", "half at ms");
    for (const CircleRow& row : study.circles) {
        const CircleFigures& f = row.figures;
        text += fmt::format("{:<10}{:<8}{:>10.0f}{:>10.3f}{:>12.2f}{:>9.1f}{:>9.1f}{:>12}\n", row.fluid,
                            to_string(row.law), row.rate_hz, f.force_n, 100.0 * f.roughness, 100.0 * f.rmse,
                            1e3 * f.lag_s, ms_of(f.half_rise_s));
    }
    for (const Goal& goal : goals_of(study))
        text += fmt::format("{:<4}{}: {}\n", goal.reached ? "yes" : "NO", goal.what, goal.found);
    return text;
}

std::string report_of(const Study& study, const StudyOrder& order, const std::string& machine,
                      const std::vector<std::filesystem::path>& pictures) {
    std::string text = fmt::format(
        R"(# What the hand feels of a slow fluid

A fluid answers twenty to seventy-five times a second, each answer a frame late; the hand must get a force a thousand times a second.
Two laws make one of the other: `force = "filter"`, the low-pass and the limit on impulses of Yang et al. 2009, and `force = "model"`,
which finds in the fluid's own answers how the force follows the body's velocity and acceleration, gives that part at once from the hand's own
motion, low-passes only the rest, and keeps books of the energy (firmware/haptic/hand_force.h): stirring costs what the drag found takes, and
no more. An exhibit has the model unless its exhibit.toml says otherwise.

Everything here was measured by `eddy haptics` on virtual time, with a simulated handle whose encoders count and whose motors are
felt; `script/report haptics` makes the page anew. The fluid `known` is a drag of {:g} N s/m and an added mass of {:g} kg in the hand, exactly.
Scenes are computed on {} cells along the longest side. {}

## What was to be reached

{}
## Near the truth, smooth, and early

The hand goes round a circle of 20 mm once a second. The reference is the same fluid with a step in every millisecond and the hand
where it really is. Roughness: what is felt less the reference, 10 to 400 Hz, as a share of the reference; trembling: of what is felt alone.
A scene's own fluid trembles as the body crosses its grid, at 1 kHz as well (of the reference), and resists otherwise when its steps are
longer; both count as roughness and error here, and are not the law's. The rest of the roughness is: by squares, since the two know nothing of
each other. After the circle the hand rests and sets off at 0.1 m/s: half of what that changes the force by after so long.
In a jet the stream's own force is in the way: when the hand's part of it comes is not to be read there from the last time.
At 1000 answers a second the encoders are what is rough: a count in a millisecond is an acceleration.
{}{}
{}
## Energy

What a cycle on the circle costs the hand, and what the fluid received in one by its own books. Below 0 the force drives the hand.
A fluid that answers seldom sees the circle as a polygon and receives less than it would of the circle: of a drag, at fs answers a second
and f cycles, the share sinc^2(f / fs) cos^2(pi f / fs). Divided by that, it is the work of such a drag on the hand's own path.
{}
{}
## Coming to rest

What still swings, as half of the largest excursion in the last second: the hand leaps by 20 mm, held by an arm (0.554 kg, 6.45 N s/m,
135 N/m, with the handle), by one three times as stiff and damped, or lets the handle (0.15 kg, 0.5 N s/m) go out of a circle of one to five turns a second, which
a jet carries to a soft wall at the bounds of the tank. The known
fluid is here as steep as the gain is limited to. `fixed`: the handle cannot move, so what swings is the flow itself. A flow that
sheds eddies shakes a handle, which is no limit cycle of the loop: beside each is what the force on the fixed handle, less its mean,
makes of a handle that is held so; where it swings more than twice as much, the handle is fixed where it came to rest, in place of the middle.

{}
## How strong the force may be

Slopes in the hand with the scene's own gain, as measured in its fluid before the show, and the gain that is left of it at each rate.

{}
## The pull of a jet

{})",
        kKnownFluid.drag_ns_m, kKnownFluid.added_kg, order.cells, machine, goal_table(study),
        picture(pictures, "force.png", "the force on the hand under both laws, and the reference"),
        picture(pictures, "quality.png", "roughness, error and lag against the rate of the fluid"),
        circle_table(study), picture(pictures, "energy.png", "energy of a cycle"), stir_table(study),
        swing_table(study), fluid_table(study), pull_table(study));
    return text;
}

std::string csv_of(const Study& study) {
    std::string text = "fluid,trial,law,rate_hz,of,value\n";
    const auto line = [&text](const std::string& fluid, const std::string& trial, ForceLaw law,
                              double rate_hz, const std::string& of, double value) {
        text += fmt::format("{},{},{},{:g},{},{:.6g}\n", fluid, trial, to_string(law), rate_hz, of, value);
    };
    for (const CircleRow& r : study.circles) {
        const auto circle = [&](const char* of, double value) {
            line(r.fluid, "circle", r.law, r.rate_hz, of, value);
        };
        circle("force_n", r.figures.force_n);
        circle("roughness", r.figures.roughness);
        circle("trembling", r.figures.trembling);
        circle("reference_trembling", r.figures.reference_trembling);
        circle("rmse", r.figures.rmse);
        circle("lag_s", r.figures.lag_s);
        if (r.figures.half_rise_s) circle("half_rise_s", *r.figures.half_rise_s);
        circle("model_drag_ns_m", r.figures.report.drag_ns_m);
        circle("model_added_kg", r.figures.report.added_kg);
        circle("model_explains", r.figures.report.explained);
        circle("least_energy_j", r.figures.report.least_j);
        circle("stored_j", r.figures.stored_j);
        circle("damped", r.figures.damped);
    }
    for (const StirRow& r : study.stirs) {
        const std::string trial = fmt::format("stir {:g} Hz", r.stir_hz);
        line(r.fluid, trial, r.law, r.rate_hz, "least_cycle_j", r.figures.least_cycle_j);
        line(r.fluid, trial, r.law, r.rate_hz, "mean_cycle_j", r.figures.mean_cycle_j);
        line(r.fluid, trial, r.law, r.rate_hz, "received_j", r.figures.received_j);
        line(r.fluid, trial, r.law, r.rate_hz, "drag_j", r.figures.drag_j);
    }
    for (const SwingRow& r : study.swings) {
        const std::string trial = fmt::format("rest {}", held_how(r));
        line(r.fluid, trial, r.law, r.rate_hz, "force_n", r.swing.force_n);
        line(r.fluid, trial, r.law, r.rate_hz, "position_m", r.swing.position_m);
        line(r.fluid, trial, r.law, r.rate_hz, "carried_force_n", r.carried.force_n);
        line(r.fluid, trial, r.law, r.rate_hz, "carried_position_m", r.carried.position_m);
    }
    for (const PullRow& r : study.pulls) line(r.fluid, "pull", ForceLaw::Model, r.rate_hz, "error", r.error);
    return text;
}

}  // namespace eddy::haptic_study
