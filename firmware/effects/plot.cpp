#include "firmware/effects/plot.h"

#include <fmt/format.h>

#include "firmware/effects/report.h"
#include "firmware/gnuplot.h"

namespace eddy::effects {
namespace {

constexpr int kAbove = 80, kBelow = 90;  ///< room for title, axes and key [px]

/// Columns: row, and both ways to add the effect as p25, p50, p75 of ms, and MB.
std::string row_text(const EffectCosts& m, std::size_t place, const EffectStudy::Row& row) {
    std::string text = fmt::format("{}", place);
    for (const EffectAdded& added : {row.to_whole, row.to_bare}) {
        const std::vector<double> ms = added_ms(m, added, m.clock);
        const double mb = (static_cast<double>(m.with(added).cost.texture_bytes) -
                           static_cast<double>(m.without(added).cost.texture_bytes)) /
                          1e6;
        text += fmt::format(" {:.5g} {:.5g} {:.5g} {:.5g}", percentile(ms, 25), median(ms),
                            percentile(ms, 75), mb);
    }
    return text + "\n";
}

}  // namespace

bool plot(const EffectCosts& m, const gles::Capabilities& driver, const std::filesystem::path& picture) {
    std::string data, names;
    const std::vector<const EffectStudy::Row*> rows = costliest_first(m);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        data += row_text(m, i, *rows[i]);
        names += fmt::format("{}'{}' {}", i == 0 ? "" : ", ", rows[i]->effect, i);
    }
    const Scene& scene = m.study.variants[0].scene;
    const glm::ivec3& n = scene.tank.cells;
    const EffectAdded& rest = m.study.all_but_bodies;
    // Three lines: single quotes take any text as it is, double ones the line break between them.
    const std::string title =
        in_gnuplot_quotes(fmt::format("What each effect adds to a step: {}, {} x {} x {} cells", scene.title,
                                      n.x, n.y, n.z)) +
        ".\"\\n\"." + in_gnuplot_quotes(driver.renderer) + ".\"\\n\"." +
        in_gnuplot_quotes(
            fmt::format("whole scene {:.3g} ms, {} {:.3g} ms", median(by(m.clock, m.with(rest).times)),
                        m.study.variants[rest.without].name, median(by(m.clock, m.without(rest).times))));
    const int height_px = kAbove + kBelow + 36 * static_cast<int>(rows.size());
    const double height = height_px;
    // Bars are boxes from 0; a whisker spans the middle half of the differences.
    const std::string commands = fmt::format(
        "$effects << EOD\n{}EOD\n"
        "set multiplot title {}\n"
        "set style fill solid 0.85 noborder\nset border 1\n"
        "set yrange [{}:-0.7]\nset ytics ({}) scale 0\nset xtics out\nset grid noytics\n"
        "set arrow 1 from 0, graph 0 to 0, graph 1 nohead lc rgb '#404040'\n"
        "set key at screen 0.5, screen {} center bottom horizontal\n"
        "set tmargin at screen {}\nset bmargin at screen {}\n"
        "set lmargin at screen 0.15\nset rmargin at screen 0.66\n"
        "set xlabel '{} time added [ms a step]'\n"
        "plot $effects using (0.5*$3):($1-0.19):(0.5*$3):(0.17) with boxxyerror lc rgb "
        "'#2050c0' title 'to the rest of the scene', \\\n"
        "     '' using (0.5*$7):($1+0.19):(0.5*$7):(0.17) with boxxyerror lc rgb '#e09020' "
        "title 'to the bodies and what it needs', \\\n"
        "     '' using 3:($1-0.19):2:4 with xerrorbars pt 0 lc rgb '#101010' notitle, \\\n"
        "     '' using 7:($1+0.19):6:8 with xerrorbars pt 0 lc rgb '#101010' title "
        "'middle half of the rounds'\n"
        "set lmargin at screen 0.69\nset rmargin at screen 0.97\nunset ytics\n"
        "unset key\nset xlabel 'textures added [MB]'\n"
        "plot $effects using (0.5*$5):($1-0.19):(0.5*$5):(0.17) with boxxyerror lc rgb "
        "'#2050c0', \\\n"
        "     '' using (0.5*$9):($1+0.19):(0.5*$9):(0.17) with boxxyerror lc rgb '#e09020'\n"
        "unset multiplot\n",
        data, title, static_cast<double>(rows.size()) - 0.3, names, 6.0 / height, 1.0 - kAbove / height,
        kBelow / height, to_string(m.clock));
    return !draw_with_gnuplot({{picture, 1200, height_px, commands}}).empty();
}

}  // namespace eddy::effects
