#include "firmware/accuracy/sweep/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "firmware/accuracy/sweep/problem.h"
#include "firmware/gnuplot.h"

namespace eddy::accuracy::sweep {

const char* colour_of(SolverPreset method) {
    switch (method) {
        case SolverPreset::Fast:
            return "#1b6ca8";
        case SolverPreset::Precise:
            return "#c8372d";
        case SolverPreset::Yang2009:
            return "#707070";
    }
    throw std::logic_error("a method without a colour");
}

int shape_of(const std::set<int>& grids, int cells) {
    // Filled triangles down and up, disk, square, diamond; then open ones.
    constexpr int kShapes[] = {11, 9, 7, 5, 13, 8, 6, 4};
    const auto place = static_cast<std::size_t>(std::distance(grids.begin(), grids.find(cells)));
    return kShapes[place % std::size(kShapes)];
}

std::set<int> grids_of(const Chosen& some) {
    std::set<int> grids;
    for (const Measurement* m : some) grids.insert(m->point.setting.cells);
    return grids;
}

Chosen line_of(const Chosen& some, SolverPreset method, int cells) {
    Chosen line;
    for (const Measurement* m : some)
        if (const Setting& s = m->point.setting; s == Setting{method, cells, s.iterations}) line.push_back(m);
    return line;
}

double time_of(const Measurement& m) {
    return m.wall_ms.p50;
}

double percent_of(const Measurement& m) {
    return 100.0 * m.error;
}

double share_of(const Measurement& m) {
    return m.error;
}

std::string data_of(const Chosen& some, const Value& x, const Value& y) {
    std::string data;
    for (const Measurement* m : some) data += fmt::format("{:.6g} {:.6g}\n", x(*m), y(*m));
    return data;
}

void Plot::add(const std::string& data, const std::string& style, const std::string& title) {
    if (data.empty()) return;
    const std::string name = fmt::format("$d{}", count_++);
    blocks_ += fmt::format("{} << EOD\n{}EOD\n", name, data);
    item(fmt::format("{} {} title {}", name, style, in_gnuplot_quotes(title)));
}

void Plot::explain(const std::string& style, const std::string& title) {
    item(fmt::format("keyentry {} title {}", style, in_gnuplot_quotes(title)));
}

std::string Plot::text() const {
    return blocks_ + "plot " + items_ + "\n";
}

void Plot::item(const std::string& text) {
    items_ += (items_.empty() ? "" : ", \\\n     ") + text;
}

void explain_methods_and_grids(Plot& plot, const Chosen& some) {
    for (const SolverPreset method : kMethods)
        if (std::any_of(some.begin(), some.end(),
                        [&](const Measurement* m) { return m->point.setting.method == method; }))
            plot.explain(fmt::format("with lines lw 2 lc rgb '{}'", colour_of(method)),
                         std::string(to_word(method)));
    const std::set<int> grids = grids_of(some);
    for (const int cells : grids)
        plot.explain(fmt::format("with points pt {} ps 1.4 lc rgb 'black'", shape_of(grids, cells)),
                     fmt::format("{} cells a side", cells));
}

void add_front(Plot& plot, const Chosen& some, const Value& error) {
    plot.add(data_of(front(some), time_of, error), "with steps lw 9 lc rgb '#f3d27a'", "best for its time");
}

void add_curves_against_time(Plot& plot, const Chosen& some, const Value& error) {
    const std::set<int> grids = grids_of(some);
    for (const SolverPreset method : kMethods)
        for (const int cells : grids)
            plot.add(data_of(line_of(some, method, cells), time_of, error),
                     fmt::format("with linespoints lw 1.5 pt {} ps 1.4 lc rgb '{}'", shape_of(grids, cells),
                                 colour_of(method)));
}

void add_other_steps(Plot& plot, const Chosen& some, const Value& error) {
    constexpr const char* kCross = "with points pt 2 ps 1.3 lw 2 lc rgb";
    bool any = false;
    for (const SolverPreset method : kMethods) {
        Chosen mine;
        for (const Measurement* m : some)
            if (m->point.setting.method == method && m->point.setting.dt_factor != 1.0) mine.push_back(m);
        any |= !mine.empty();
        plot.add(data_of(mine, time_of, error), fmt::format("{} '{}'", kCross, colour_of(method)));
    }
    if (any) plot.explain(fmt::format("{} 'black'", kCross), "other time steps");
}

const char* const kPercentAxis =
    "set logscale y\nset format y '%g %%'\nset ytics add (0.2, 0.5, 2, 5, 20, 50, 200, 500)\n";
const char* const kTimeAxis =
    "set logscale x\nset xtics add (2, 5, 20, 50, 200, 500, 2000, 5000)\n"
    "set xlabel 'wall time of a step [ms], median'\n";

std::string real_time_lines() {
    std::string text;
    for (const double rate : kRatesHz)
        text += fmt::format(
            "set arrow from {0:.4g}, graph 0 to {0:.4g}, graph 1 nohead dt 3 lw 1.5 lc rgb '#2a8a3a'\n"
            "set label '{1} Hz' at {0:.4g}, graph 0.62 left rotate by 90 offset 0.7,0 tc rgb '#2a8a3a'\n",
            1e3 / rate, rate);
    return text;
}

std::string range(const char* axis, const Chosen& some, const Value& value,
                  std::initializer_list<double> also) {
    double low = std::numeric_limits<double>::infinity(), high = 0.0;
    const auto include = [&](double v) {
        if (!(v > 0.0)) return;
        low = std::min(low, v);
        high = std::max(high, v);
    };
    for (const Measurement* m : some) include(value(*m));
    for (const double v : also) include(v);
    return high > 0.0 ? fmt::format("set {}range [{:.4g}:{:.4g}]\n", axis, low / 1.3, high * 1.3) : "";
}

}  // namespace eddy::accuracy::sweep
