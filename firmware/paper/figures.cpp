#include "firmware/paper/figures.h"

#include <fmt/format.h>

#include "firmware/gnuplot.h"
#include "firmware/text_file.h"

namespace eddy::paper {
namespace {

// Renderer, clock, table.
constexpr const char* kPage =
    R"(## The figures of the 2009 paper, from this program

Yang, Lu, Safonova and Kuchenbecker compare two ways to add up the force of every cell: in a tree of passes on the GPU, reading
one texel back, or on the CPU, reading all of them back. `eddy bench --paper` runs both in the preset `yang2009`, which is their
pipeline, here on {0}. Figure 8 is of wall time, figures 9 and 10 of {1} time with the GPU drained before and after each part;
all are medians. Where a software rasteriser draws, both ways run on the same processor: what differs is the passes and the
copying, not the way over a bus.

![updates a second](figure_8.png)

![a step by part](figure_9.png)

![the sum alone](figure_10.png)

Their Table I, with our rows below theirs:

{2})";

/// Columns: cells; whole step, fluid, force, integral with the sum on the GPU; the same with it on the CPU [ms].
std::string data(const std::vector<ForceCost>& costs, const char* separator) {
    std::string text;
    for (const ForceCost& c : costs) {
        text += fmt::format("{}", c.cells);
        for (const ForceCost::Parts& p : {c.on_gpu, c.on_cpu})
            for (const double ms : {p.step, p.fluid, p.force, p.integral})
                text += fmt::format("{}{:.5g}", separator, ms);
        text += "\n";
    }
    return text;
}

/// The columns of data(): where the sum was made, of what, by which clock.
std::string header(CostClock clock) {
    std::string text = "cells";
    for (const char* sum : {"gpu", "cpu"}) {
        text += fmt::format(",sum_on_{}_step_{}_ms", sum, to_string(CostClock::Wall));
        for (const char* part : {"fluid", "force", "integral"})
            text += fmt::format(",sum_on_{}_{}_{}_ms", sum, part, to_string(clock));
    }
    return text + "\n";
}

GnuplotPicture figure(const std::filesystem::path& file, const std::string& title,
                      const std::vector<ForceCost>& costs, const std::string& commands) {
    return {file, 900, 560,
            fmt::format("set grid noxtics\n$costs << EOD\n{}EOD\nset title {}\n{}", data(costs, " "),
                        in_gnuplot_quotes(title), commands)};
}

std::string table(const std::vector<Implementation>& ours) {
    std::string text = "| implementation | grid | updates a second | on |\n|---|---|---|---|\n";
    for (const auto* rows : {&published(), &ours})
        for (const Implementation& row : *rows)
            text += fmt::format("| {} | {} | {:.3g} | {} |\n", row.name, row.grid, row.updates_per_s,
                                row.hardware);
    return text;
}

}  // namespace

const std::vector<Implementation>& published() {
    static const std::vector<Implementation> rows{
        {"Baxter and Lin 2004, in the plane", "64 × 64", 60.0, "not said"},
        {"Mora and Lee 2008, in the plane", "15 × 15 (× 15)", 30.0, "not said"},
        {"Yang et al. 2009", "70 × 70 × 70", 55.0, "NVIDIA 8800 GT, Intel Q6600"}};
    return rows;
}

bool draw_figures(const std::filesystem::path& folder, const std::vector<ForceCost>& costs,
                  const std::vector<Implementation>& ours, const std::string& renderer, CostClock clock) {
    replace_text_file(folder / "paper.csv", header(clock) + data(costs, ","));
    const std::string cells = "set xlabel 'cells along each side'\n";
    const std::string ms = fmt::format("set ylabel '{} time [ms a step]'\n", to_string(clock));
    const std::vector<GnuplotPicture> figures{
        figure(folder / "figure_8.png", "Updates a second, force added up on GPU and CPU: " + renderer, costs,
               cells + "set ylabel 'updates a second'\nset logscale y\nset key top right\n"
                       "plot $costs using 1:(1000/$2) with linespoints lw 2 pt 7 lc rgb '#2050c0' "
                       "title 'GPU', '' using 1:(1000/$6) with linespoints lw 2 pt 5 lc rgb '#e09020' "
                       "title 'CPU'\n"),
        figure(folder / "figure_9.png",
               "A step by part; left bars: force added up on GPU, right: on CPU; " + renderer, costs,
               cells + ms +
                   "set key top left\nset style fill solid 0.85 noborder\nset boxwidth 0.35\n"
                   "set xrange [-0.6:*]\nset yrange [0:*]\n"
                   "plot $costs using ($0-0.19):($3+$4):xtic(1) with boxes lc rgb '#e09020' title 'force', "
                   "'' using ($0-0.19):3 with boxes lc rgb '#2050c0' title 'fluid', "
                   "'' using ($0+0.19):($7+$8) with boxes lc rgb '#e09020' notitle, "
                   "'' using ($0+0.19):7 with boxes lc rgb '#2050c0' notitle\n"),
        figure(folder / "figure_10.png", "Adding up the force alone: " + renderer, costs,
               cells + ms +
                   "set logscale y\nset key top left\n"
                   "plot $costs using 1:5 with linespoints lw 2 pt 7 lc rgb '#2050c0' title 'GPU', "
                   "'' using 1:9 with linespoints lw 2 pt 5 lc rgb '#e09020' title 'CPU'\n")};
    replace_text_file(folder / "paper.md", fmt::format(kPage, renderer, to_string(clock), table(ours)));
    return draw_with_gnuplot(figures).size() == figures.size();
}

}  // namespace eddy::paper
