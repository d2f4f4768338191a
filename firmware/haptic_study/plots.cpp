#include <fmt/format.h>

#include <algorithm>

#include "firmware/haptic_study/report.h"

namespace eddy::haptic_study {
namespace {

constexpr const char* kColours[] = {"#2050c0", "#e09020", "#208040", "#a03080", "#606060"};

std::vector<std::string> fluids_of(const Study& study) {
    std::vector<std::string> names;
    for (const CircleRow& row : study.circles)
        if (std::find(names.begin(), names.end(), row.fluid) == names.end()) names.push_back(row.fluid);
    return names;
}

/// The force to the right under both laws at 20 and 50 answers a second, in the known fluid and in the first scene.
GnuplotPicture force_picture(const Study& study, const std::filesystem::path& folder) {
    const std::vector<std::string> all = fluids_of(study);
    const std::size_t shown = std::min<std::size_t>(all.size(), 2);
    std::string data, plots;
    for (std::size_t f = 0; f < shown; ++f)
        for (const double rate_hz : {20.0, 50.0}) {
            const std::string name = fmt::format("$f{}_{:.0f}", f, rate_hz);
            std::vector<const CircleFigures*> laws;
            for (const ForceLaw law : kLaws)
                for (const CircleRow& row : study.circles)
                    if (row.fluid == all[f] && row.rate_hz == rate_hz && row.law == law)
                        laws.push_back(&row.figures);
            if (laws.size() != 2) continue;
            data += name + " << EOD\n";
            for (std::size_t ms = 0; ms < laws[0]->felt.size(); ms += 2)
                data += fmt::format("{} {:.5g} {:.5g} {:.5g}\n", ms, laws[0]->reference[ms].x,
                                    laws[0]->felt[ms].x, laws[1]->felt[ms].x);
            data += "EOD\n";
            plots += fmt::format(
                "set title {}\n"
                "plot {} using 1:2 with lines lw 4 lc rgb '#c0c0c0' title 'the fluid at 1 kHz', \\\n"
                "     '' using 1:3 with lines lw 1.5 lc rgb '{}' title 'filter', \\\n"
                "     '' using 1:4 with lines lw 1.5 lc rgb '{}' title 'model'\n",
                in_gnuplot_quotes(fmt::format("{}, {:.0f} answers a second", all[f], rate_hz)), name,
                kColours[1], kColours[0]);
        }
    return {folder / "force.png", 1100, 380 * static_cast<int>(shown),
            fmt::format(
                "{}set multiplot layout {},2\nset xlabel 'time [ms]'\nset ylabel 'force to the right [N]'\n"
                "set key outside bottom center horizontal\n{}unset multiplot\n",
                data, shown, plots)};
}

/// Roughness, rmse and lag over the rate: a colour for each fluid, dashed for the filter.
GnuplotPicture quality_picture(const Study& study, const std::filesystem::path& folder) {
    const std::vector<std::string> names = fluids_of(study);
    std::string data;
    struct Panel {
        const char *title, *extra;
    };
    const Panel panels[] = {{"roughness [%]", "set logscale y\nset yrange [0.03:100]\n"},
                            {"rmse [%]", "unset logscale y\nset yrange [0:*]\n"},
                            {"lag [ms]", ""}};
    std::string plots[3];
    for (std::size_t f = 0; f < names.size(); ++f)
        for (const ForceLaw law : kLaws) {
            const std::string name = fmt::format("$d{}_{}", f, to_string(law));
            data += name + " << EOD\n";
            for (const CircleRow& row : study.circles)
                if (row.fluid == names[f] && row.law == law && row.rate_hz < 100.0)
                    data +=
                        fmt::format("{} {:.5g} {:.5g} {:.5g}\n", row.rate_hz, 100.0 * row.figures.roughness,
                                    100.0 * row.figures.rmse, 1e3 * row.figures.lag_s);
            data += "EOD\n";
            for (int panel = 0; panel < 3; ++panel)
                plots[panel] += fmt::format(
                    "{}{} using 1:{} with linespoints lw 2 pt 7 ps 0.8 dt {} lc rgb '{}' title {}",
                    plots[panel].empty() ? "plot " : ", \\\n     ", name, panel + 2,
                    law == ForceLaw::Filter ? 2 : 1, kColours[f % std::size(kColours)],
                    in_gnuplot_quotes(fmt::format("{}, {}", names[f], to_string(law))));
        }
    std::string commands = data +
                           "set multiplot layout 1,3\nset xlabel 'answers a second'\nset xrange [15:80]\nset "
                           "xtics (20, 30, 50, 75)\n";
    for (int panel = 0; panel < 3; ++panel)
        commands += fmt::format("{}set title {}\n{}\n{}\n", panels[panel].extra,
                                in_gnuplot_quotes(panels[panel].title),
                                panel == 0 ? "set key bottom left font ',8'" : "unset key", plots[panel]);
    return {folder / "quality.png", 1300, 460, commands + "unset multiplot\n"};
}

/// What a cycle costs, as a share of what its drag would take, at 20 answers a second.
GnuplotPicture energy_picture(const Study& study, const std::filesystem::path& folder) {
    const std::vector<std::string> names = fluids_of(study);
    std::string data, plot;
    for (std::size_t f = 0; f < names.size(); ++f)
        for (const ForceLaw law : kLaws) {
            std::string lines;
            for (const StirRow& row : study.stirs)
                if (row.fluid == names[f] && row.law == law && row.rate_hz == 20.0)
                    lines += fmt::format("{} {:.5g}\n", row.stir_hz,
                                         row.figures.mean_cycle_j / row.figures.drag_j);
            if (lines.empty()) continue;
            const std::string name = fmt::format("$e{}_{}", f, to_string(law));
            data += name + " << EOD\n" + lines + "EOD\n";
            plot += fmt::format("{}{} with linespoints lw 2 pt 7 dt {} lc rgb '{}' title {}",
                                plot.empty() ? "plot " : ", \\\n     ", name, law == ForceLaw::Filter ? 2 : 1,
                                kColours[f % std::size(kColours)],
                                in_gnuplot_quotes(fmt::format("{}, {}", names[f], to_string(law))));
        }
    return {
        folder / "energy.png", 900, 460,
        data +
            "set logscale x\nset xrange [0.4:6]\nset xtics (0.5, 1, 2, 5)\nset xlabel 'the hand stirs [Hz]'\n"
            "set ylabel 'cost of a cycle / work of such a drag'\nset key outside right top reverse Left\n"
            "set title 'Energy at 20 answers a second: below 0 the force drives the hand'\n"
            "set arrow 1 from 0.4,0 to 6,0 nohead lc rgb '#404040'\n" +
            plot + "\n"};
}

}  // namespace

std::vector<GnuplotPicture> pictures_of(const Study& study, const std::filesystem::path& folder) {
    return {force_picture(study, folder), quality_picture(study, folder), energy_picture(study, folder)};
}

}  // namespace eddy::haptic_study
