#include "firmware/accuracy/sweep/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "firmware/accuracy/sweep/curves.h"
#include "firmware/accuracy/sweep/pareto.h"
#include "firmware/accuracy/sweep/problem.h"

namespace eddy::accuracy::sweep {
namespace {

double iterations_of(const Measurement& m) {
    return m.point.setting.iterations;
}

double cells_of(const Measurement& m) {
    return m.point.setting.cells;
}

GnuplotPicture work_precision(const Table& table, const Problem& problem) {
    const Chosen some = points_of(table, problem.name);
    Plot plot;
    add_front(plot, some, percent_of);
    add_curves_against_time(plot, some, percent_of);
    add_other_steps(plot, some, percent_of);
    explain_methods_and_grids(plot, some);
    std::string text = std::string(kPercentAxis) + kTimeAxis + real_time_lines();
    text += range("x", some, time_of, {1e3 / 75, 1e3 / 20}) +
            range("y", some, percent_of, {100.0 * problem.hand});
    text +=
        fmt::format("set title {}\nset ylabel 'error of the {}'\nset key outside right top reverse Left\n",
                    in_gnuplot_quotes(problem.name + ": " + problem.title), problem.error);
    text += fmt::format(
        "set arrow from graph 0, first {0:.3g} to graph 1, first {0:.3g} nohead dt 2 lc rgb '#8040a0'\n"
        "set label 'below: a hand cannot tell' at graph 0.99, first {0:.3g} right offset 0,-0.7 tc rgb "
        "'#8040a0'\n",
        100.0 * problem.hand);
    return {"work_" + problem.name + ".png", 1100, 750, text + plot.text()};
}

std::optional<GnuplotPicture> iterations_plot(const Table& table) {
    const Chosen some = points_of(table, "B2");
    const std::set<int> grids = grids_of(some);
    std::string panels;
    const std::pair<const char*, std::vector<SolverPreset>> kPanels[] = {
        {"multigrid V-cycles a step", {SolverPreset::Fast, SolverPreset::Precise}},
        {"Jacobi sweeps a step", {SolverPreset::Yang2009}}};
    for (const auto& [label, methods] : kPanels) {
        Plot plot;
        std::string knees;
        Chosen shown;
        for (const SolverPreset method : methods)
            for (const int cells : grids) {
                const Chosen line = line_of(some, method, cells);
                if (line.size() < 2) continue;
                shown.insert(shown.end(), line.begin(), line.end());
                plot.add(data_of(line, iterations_of, percent_of),
                         fmt::format("with linespoints lw 1.5 pt {} ps 1.4 lc rgb '{}'",
                                     shape_of(grids, cells), colour_of(method)));
                if (const Measurement* m = enough(line)) knees += data_of({m}, iterations_of, percent_of);
            }
        if (plot.empty()) continue;
        plot.add(knees, "with points pt 6 ps 3.2 lw 2 lc rgb '#e08a00'", "more is waste");
        explain_methods_and_grids(plot, shown);
        const bool sweeps = methods.front() == SolverPreset::Yang2009;
        panels += range("x", shown, iterations_of);
        panels +=
            fmt::format("set xlabel '{}'\nset key {} reverse Left\nset logscale x 2\nset xtics ({})\n{}",
                        label, sweeps ? "bottom left" : "top right",
                        sweeps ? "5, 10, 20, 40, 80, 160, 320" : "1, 2, 3, 4, 6, 8, 12", plot.text());
    }
    if (panels.empty()) return std::nullopt;
    // One scale for both panels.
    const std::string errors = range("y", some, percent_of);
    return GnuplotPicture{
        "iterations.png", 1300, 700,
        std::string(kPercentAxis) + errors +
            "set ylabel 'error of the force, worst of 4 places'\n"
            "set multiplot layout 1,2 title 'B2: a ball speeds up. Error against iterations of the "
            "pressure'\n" +
            panels};
}

std::optional<GnuplotPicture> stages_plot(const Table& table) {
    constexpr const char* kColours[] = {"#4c78a8", "#f58518", "#54a24b", "#e45756", "#72b7b2",
                                        "#b279a2", "#eeca3b", "#9d755d", "#79706e", "#bab0ac"};
    Chosen some = chosen(table.measured, [](const Measurement& m) { return !m.stages.empty(); });
    if (some.empty()) return std::nullopt;
    std::vector<std::string> stages;
    for (const Measurement* m : some)
        for (const auto& stage : m->stages)
            if (std::find(stages.begin(), stages.end(), stage.first) == stages.end())
                stages.push_back(stage.first);
    std::string panels;
    for (const SolverPreset method : kMethods) {
        std::string data, totals;
        int row = 0;
        for (const Measurement* m : some) {
            const Setting& s = m->point.setting;
            if (s.method != method) continue;
            const double million_cells = 1e-6 * s.cells * s.cells * s.cells;
            double sum = 0.0;
            data += fmt::format("\"{}^3\"", s.cells);
            for (const std::string& stage : stages) {
                double ms = 0.0;
                for (const auto& [name, time] : m->stages)
                    if (name == stage) ms = time;
                sum += ms;
                data += fmt::format(" {:.5g}", ms / million_cells);
            }
            data += "\n";
            totals += fmt::format("{} {:.5g} {:.3g}\n", row++, sum / million_cells, sum);
        }
        if (data.empty()) continue;
        const std::string name(to_word(method));
        panels +=
            fmt::format("set title '{} with {} {}'\n$s_{} << EOD\n{}EOD\n$t_{} << EOD\n{}EOD\nplot ", name,
                        usual_iterations(method), method == SolverPreset::Yang2009 ? "sweeps" : "cycles",
                        name, data, name, totals);
        for (std::size_t i = 0; i < stages.size(); ++i)
            panels +=
                fmt::format("$s_{} using {}{} title {} lc rgb '{}', ", name, i + 2, i == 0 ? ":xtic(1)" : "",
                            in_gnuplot_quotes(stages[i]), kColours[i % std::size(kColours)]);
        panels += fmt::format(
            "$t_{} using 1:2:(sprintf('%g ms', $3)) with labels offset 0,0.7 notitle\nset key off\nunset "
            "ylabel\n",
            name);
    }
    return GnuplotPicture{
        "stages.png", 1400, 650,
        "set style data histograms\nset style histogram rowstacked\nset style fill solid border -1\n"
        "set boxwidth 0.7\nset ylabel 'wall time of a step per million cells [ms]'\nset yrange [0:*]\n"
        "set offsets 0, 0, graph 0.45, 0\nset key top left reverse Left\n"
        "set multiplot layout 1,3 title 'B2: where the time of a step goes (each panel has its own scale; "
        "above a bar: the sum of its stages)'\n" +
            panels};
}

std::optional<GnuplotPicture> viscosity_plot(const Table& table) {
    const Chosen some = points_of(table, "A1");
    std::map<std::pair<SolverPreset, double>, std::string> lines;
    for (const Measurement* m : some) {
        const Setting& s = m->point.setting;
        if (s.iterations == usual_iterations(s.method))
            lines[{s.method, s.dt_factor}] += fmt::format("{} {:.6g}\n", s.cells, 100.0 * m->error);
    }
    Plot plot;
    for (const auto& [which, data] : lines) {
        const auto& [method, factor] = which;
        const int dash = factor == 1.0 ? 1 : factor < 1.0 ? 3 : 2;
        plot.add(data,
                 fmt::format("with linespoints lw 2 dt {} pt 7 ps 1.2 lc rgb '{}'", dash, colour_of(method)),
                 fmt::format("{}, Courant number {}", to_word(method), 0.5 * factor));
    }
    if (plot.empty()) return std::nullopt;
    std::string ticks;
    for (const int cells : grids_of(some)) ticks += fmt::format("{}{}", ticks.empty() ? "" : ", ", cells);
    return GnuplotPicture{
        "viscosity.png", 1000, 700,
        std::string(kPercentAxis) + range("y", some, percent_of) + range("x", some, cells_of) +
            "set logscale x 2\nset xlabel 'cells along the longest side'\n"
            "set ylabel 'numerical viscosity over the true one'\nset key outside right top reverse Left\n"
            "set title 'A1: vortices of Taylor and Green at Re 10 die away too fast'\n" +
            fmt::format("set xtics ({})\n", ticks) + plot.text()};
}

GnuplotPicture ripple_plot(const Table& table) {
    const Chosen some = points_of(table, "B8.7");
    Plot plot;
    add_front(plot, some, share_of);
    add_curves_against_time(plot, some, share_of);
    add_other_steps(plot, some, share_of);
    std::string iterations, shorter, longer;
    for (const Measurement* m : some) {
        const Setting& s = m->point.setting;
        const std::string place = fmt::format("{:.6g} {:.6g}", m->wall_ms.p50, m->error);
        if (s.dt_factor == 1.0)
            iterations += fmt::format("{} x{}\n", place, s.iterations);
        else
            (s.dt_factor < 1.0 ? shorter : longer) += fmt::format("{} \"{} dt\"\n", place, s.dt_factor);
    }
    plot.add(iterations, "using 1:2:3 with labels left offset 0.8,0.6 tc rgb '#404040'");
    plot.add(shorter, "using 1:2:3 with labels right offset -0.8,0 tc rgb '#404040'");
    plot.add(longer, "using 1:2:3 with labels left offset 0.8,-0.2 tc rgb '#404040'");
    explain_methods_and_grids(plot, some);
    return GnuplotPicture{
        "ripple.png", 1100, 700,
        std::string(kTimeAxis) + real_time_lines() + range("x", some, time_of, {1e3 / 75, 1e3 / 20}) +
            range("y", some, share_of) +
            "set logscale y\nset ytics add (0.002, 0.003, 0.005, 0.02, 0.03, 0.05)\n"
            "set ylabel 'ripple of the drag coefficient, rms'\n"
            "set key outside right top reverse Left\n"
            "set title 'B8.7: a ball glides over the cells. How much its force trembles, against time'\n" +
            plot.text()};
}

}  // namespace

std::vector<GnuplotPicture> pictures_of(const Table& table, const std::filesystem::path& folder) {
    std::vector<GnuplotPicture> pictures;
    for (const Problem& problem : all_problems())
        if (problem.hand > 0.0 && !points_of(table, problem.name).empty())
            pictures.push_back(work_precision(table, problem));
    for (std::optional<GnuplotPicture> picture :
         {iterations_plot(table), stages_plot(table), viscosity_plot(table)})
        if (picture) pictures.push_back(*std::move(picture));
    if (!points_of(table, "B8.7").empty()) pictures.push_back(ripple_plot(table));
    for (GnuplotPicture& picture : pictures) picture.file = folder / picture.file;
    return pictures;
}

}  // namespace eddy::accuracy::sweep
