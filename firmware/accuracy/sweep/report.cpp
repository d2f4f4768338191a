#include "firmware/accuracy/sweep/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "firmware/accuracy/sweep/pareto.h"
#include "firmware/accuracy/sweep/problem.h"

namespace eddy::accuracy::sweep {
namespace {

constexpr double kRatesHz[] = {20.0, 50.0, 75.0};  // of the fluid, on an exhibit

std::string percent(double share) {
    return fmt::format("{:.2g} %", 100.0 * share);
}

/// "52.9 ms", "2870 ms".
std::string ms_text(double ms) {
    return ms < 1000.0 ? fmt::format("{:.3g} ms", ms) : fmt::format("{:.0f} ms", ms);
}

std::string with_method(const Measurement& m) {
    return fmt::format("{} with {}", percent(m.error), describe(m.point.setting));
}

/// "12.3 ms 32^3 x2": time, grid, iterations; a step shorter or longer than the case's is named.
std::string cell_of(const Measurement* m) {
    if (m == nullptr) return "-";
    const Setting& s = m->point.setting;
    std::string text = fmt::format("{} {}^3 x{}", ms_text(m->wall_ms.p50), s.cells, s.iterations);
    if (s.dt_factor != 1.0) text += fmt::format(" {}dt", s.dt_factor);
    return text;
}

Chosen of_method(const Chosen& some, SolverPreset method) {
    Chosen result;
    for (const Measurement* m : some)
        if (m->point.setting.method == method) result.push_back(m);
    return result;
}

std::string headline(const Problem& problem, const Chosen& measured) {
    constexpr int kWidth = 20;
    std::string text = fmt::format("\n{}  {}\n  {:<10}", problem.name, problem.title, "error of");
    for (const Threshold& t : problem.thresholds) text += fmt::format("{:<{}}", t.name, kWidth);
    text += "best\n";
    for (const SolverPreset method : kMethods) {
        const Chosen mine = of_method(measured, method);
        if (mine.empty()) continue;
        text += fmt::format("  {:<10}", to_word(method));
        for (const Threshold& t : problem.thresholds)
            text += fmt::format("{:<{}}", cell_of(quickest_within(mine, t.error)), kWidth);
        const Chosen best = front(mine);
        text += best.empty() ? "-\n"
                             : fmt::format("{} in {}\n", percent(best.back()->error), cell_of(best.back()));
    }
    for (const double rate : kRatesHz)
        if (const Measurement* best = best_within(measured, 1e3 / rate))
            text += fmt::format("  at {:.0f} Hz (a step within {:.3g} ms): {}\n", rate, 1e3 / rate,
                                with_method(*best));
        else
            text += fmt::format("  at {:.0f} Hz (a step within {:.3g} ms): nothing that was tried\n", rate,
                                1e3 / rate);
    return text;
}

/// One line for each method: its least and its usual error, on each grid.
std::string errors_by_grid(const Problem& problem, const Chosen& measured) {
    std::string text = fmt::format("\n{}  {}\n", problem.name, problem.title);
    for (const SolverPreset method : kMethods)
        for (const Measurement* m : of_method(measured, method))
            if (const Setting& s = m->point.setting; s.iterations == usual_iterations(method))
                text +=
                    fmt::format("  {:<36}{:>9}{:>13}\n", describe(s),
                                problem.name == "A1" ? percent(m->error) : fmt::format("{:.2g}", m->error),
                                ms_text(m->wall_ms.p50));
    return text;
}

std::string waste(const Table& table) {
    std::string text;
    for (const SolverPreset method : kMethods) {
        std::vector<std::string> grids;
        for (const Measurement& first : table.measured) {
            const Setting& s = first.point.setting;
            // One line of settings is named by its first.
            const Chosen line = chosen(table.measured, [&](const Measurement& m) {
                const Setting& other = m.point.setting;
                return m.point.problem == "B2" && other == Setting{method, s.cells, other.iterations};
            });
            if (line.empty() || line.front() != &first) continue;
            if (const Measurement* m = enough(line))
                grids.push_back(fmt::format("{} on {}^3", m->point.setting.iterations, s.cells));
        }
        if (!grids.empty()) text += fmt::format("  {:<10}{}\n", to_word(method), fmt::join(grids, ", "));
    }
    if (text.empty()) return text;
    return "\nB2  iterations after which all the rest gains less than a tenth of the error\n" + text;
}

/// What it costs to measure the force otherwise, and what that changes.
std::string force_ways(const Table& table) {
    std::string text;
    for (const Measurement& m : table.measured) {
        const Setting& s = m.point.setting;
        const bool compared =
            std::any_of(table.measured.begin(), table.measured.end(), [&](const Measurement& other) {
                Setting surface = other.point.setting;
                surface.force = ForceWay::Surface;
                return other.point.setting.force != ForceWay::Surface &&
                       other.point.problem == m.point.problem &&
                       surface == Setting{s.method, s.cells, s.iterations, s.dt_factor};
            });
        if (compared)
            text +=
                fmt::format("  {:<40}{:>9}{:>13}\n", describe(s), percent(m.error), ms_text(m.wall_ms.p50));
    }
    return text.empty() ? text : "\nB2  the force measured in three ways\n" + text;
}

}  // namespace

std::optional<Yardstick> yardstick(const Table& table) {
    std::optional<Yardstick> found;
    constexpr int kCells = 64, kMostSweeps = 160;
    for (const Measurement& fast : table.measured) {
        const int cells = fast.point.setting.cells;
        if (fast.point != Point{"B2", {SolverPreset::Fast, cells, usual_iterations(SolverPreset::Fast)}})
            continue;
        const Measurement* best = nullptr;
        for (const Measurement& m : table.measured) {
            const Setting& s = m.point.setting;
            if (m.point.problem == "B2" && s.method == SolverPreset::Yang2009 && s.cells == cells &&
                s.iterations <= kMostSweeps && (best == nullptr || m.error < best->error))
                best = &m;
        }
        const bool better =
            !found || cells == kCells ||
            (found->fast->point.setting.cells != kCells && cells > found->fast->point.setting.cells);
        if (best != nullptr && better) found = Yardstick{&fast, best};
    }
    return found;
}

std::string report_of(const Table& table) {
    std::string text = fmt::format("{}\n", table.renderer);
    for (const std::string& machine : table.machines) text += machine + "\n";
    if (table.machines.size() > 1)
        text += "Times of different machines are mixed here: compare errors, not times.\n";
    text +=
        "Times are wall time of a step, median of its repeats; x2 is two multigrid cycles, or Jacobi sweeps "
        "of yang2009.\n"
        "The first step, whose force is B2's error, takes three cycles more; times are of later steps.\n";
    for (const Problem& problem : all_problems()) {
        const Chosen measured = points_of(table, problem.name);
        if (measured.empty()) continue;
        text += problem.thresholds.empty() ? errors_by_grid(problem, measured) : headline(problem, measured);
    }
    text += waste(table) + force_ways(table);
    if (const std::optional<Yardstick> y = yardstick(table)) {
        const double share = y->fast->wall_ms.p50 / y->yang2009->wall_ms.p50;
        text += fmt::format(
            "\nB2 on {}^3: fast is off by {} in {} a step; yang2009 by {} at best, with {} "
            "sweeps in {}\n  {}\n",
            y->fast->point.setting.cells, percent(y->fast->error), ms_text(y->fast->wall_ms.p50),
            percent(y->yang2009->error), y->yang2009->point.setting.iterations,
            ms_text(y->yang2009->wall_ms.p50),
            y->fast->error <= y->yang2009->error ? fmt::format("as exact in {:.2g} of the time", share)
                                                 : "fast does not get as exact");
    }
    text +=
        "\nNot swept, for Eddy has them not: half precision (all of it computes in 32 bits), stopping at a "
        "tolerance "
        "(iterations\nare fixed), yang2009 in A1 (its velocities do not lie on faces). Transport and "
        "boundaries change with "
        "the method.\n";
    return text;
}

}  // namespace eddy::accuracy::sweep
