#include "firmware/accuracy/sweep/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "firmware/accuracy/sweep/pareto.h"
#include "firmware/accuracy/sweep/problem.h"

namespace eddy::accuracy::sweep {
namespace {

std::string percent(double share) {
    return fmt::format("{:.2g} %", 100.0 * share);
}

/// "52.9 ms", "2870 ms".
std::string ms_text(double ms) {
    return ms < 1000.0 ? fmt::format("{:.3g} ms", ms) : fmt::format("{:.0f} ms", ms);
}

std::string with_method(const Measurement& m) {
    return fmt::format("{} off, with {}", percent(m.error), describe(m.point.setting));
}

/// "12.3 ms: 32³ ×2": time, grid, iterations; a step shorter or longer than the case's is named.
std::string cell_of(const Measurement* m) {
    if (m == nullptr) return "–";
    const Setting& s = m->point.setting;
    std::string text = fmt::format("{}: {}³ ×{}", ms_text(m->wall_ms.p50), s.cells, s.iterations);
    if (s.dt_factor != 1.0) text += fmt::format(", {} dt", s.dt_factor);
    return text;
}

Chosen of_method(const Chosen& some, SolverPreset method) {
    Chosen result;
    for (const Measurement* m : some)
        if (m->point.setting.method == method) result.push_back(m);
    return result;
}

/// The time that each error takes, and what a rate allows.
std::string headline(const Problem& problem, const Chosen& measured) {
    std::string text = "| within", rule = "|---";
    for (const Threshold& t : problem.thresholds) {
        text += " | " + t.name;
        rule += "|---";
    }
    text += " | best |\n" + rule + "|---|\n";
    for (const SolverPreset method : kMethods) {
        const Chosen mine = of_method(measured, method);
        if (mine.empty()) continue;
        text += fmt::format("| `{}`", to_word(method));
        for (const Threshold& t : problem.thresholds) text += " | " + cell_of(quickest_within(mine, t.error));
        const Chosen best = front(mine);
        text += best.empty()
                    ? " | – |\n"
                    : fmt::format(" | {} in {} |\n", percent(best.back()->error), cell_of(best.back()));
    }
    text += "\n";
    for (const double rate : kRatesHz) {
        const Measurement* best = best_within(measured, 1e3 / rate);
        text += fmt::format("- At {:.0f} Hz, a step within {:.3g} ms: {}.\n", rate, 1e3 / rate,
                            best ? with_method(*best) : "nothing that was tried");
    }
    return text;
}

/// A row for each setting with the iterations that are usual for its method.
std::string usual_settings(const Problem& problem, const Chosen& measured) {
    std::string text = fmt::format("| setting | error of the {} | time |\n|---|---|---|\n", problem.error);
    for (const SolverPreset method : kMethods)
        for (const Measurement* m : of_method(measured, method))
            if (const Setting& s = m->point.setting; s.iterations == usual_iterations(method))
                text +=
                    fmt::format("| {} | {} | {} |\n", describe(s),
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
                grids.push_back(fmt::format("{} on {}³", m->point.setting.iterations, s.cells));
        }
        if (!grids.empty()) text += fmt::format("- `{}`: {}\n", to_word(method), fmt::join(grids, ", "));
    }
    if (text.empty()) return text;
    return "\n## How many iterations are enough\n\nIn case B2, all iterations after these together gain less "
           "than a "
           "tenth of the error:\n\n" +
           text + "\n![error against iterations](iterations.png)\n";
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
            text += fmt::format("| {} | {} | {} |\n", describe(s), percent(m.error), ms_text(m.wall_ms.p50));
    }
    if (text.empty()) return text;
    return "\n## The force measured in three ways\n\nFrom pressure and friction on the surface, as the "
           "exhibit does it; "
           "from the balance of momentum in a box around\nthe body; from the impulse that the body gives to "
           "the fluid "
           "it touches. Case B2:\n\n| setting | error of the force | time |\n|---|---|---|\n" +
           text;
}

std::string against_2009(const Table& table) {
    const std::optional<Yardstick> y = yardstick(table);
    if (!y) return "";
    const double share = y->fast->wall_ms.p50 / y->yang2009->wall_ms.p50;
    return fmt::format(
        "- Against the method of 2009, {}³ cells: `fast` is {} off in {} a step; `yang2009` {} off at best, "
        "with {} "
        "sweeps in {}: {}.\n",
        y->fast->point.setting.cells, percent(y->fast->error), ms_text(y->fast->wall_ms.p50),
        percent(y->yang2009->error), y->yang2009->point.setting.iterations, ms_text(y->yang2009->wall_ms.p50),
        y->fast->error <= y->yang2009->error ? fmt::format("as exact in {:.2g} of the time", share)
                                             : "`fast` does not get as exact");
}

/// "- A force that a hand cannot tell from the true one (7 %): 24.4 ms a step, fast 32^3, 1 cycle."
std::string in_short(const Table& table) {
    std::string text;
    for (const Problem& problem : all_problems()) {
        if (!(problem.hand > 0.0)) continue;
        const Chosen measured = points_of(table, problem.name);
        const auto line = [&](double error, const std::string& what) {
            if (measured.empty()) return;
            const Measurement* m = quickest_within(measured, error);
            text += fmt::format(
                "- {}: {}.\n", what,
                m ? fmt::format("{} a step, {}", ms_text(m->wall_ms.p50), describe(m->point.setting))
                  : "nothing that was tried");
        };
        line(problem.hand, fmt::format("{}: error that a hand cannot tell ({:.0f} %)", problem.plain,
                                       100.0 * problem.hand));
        line(0.01, fmt::format("{}: error of 1 %", problem.plain));
    }
    text += against_2009(table);
    return text.empty() ? text : "\n## In short\n\n" + text;
}

}  // namespace

std::optional<Yardstick> yardstick(const Table& table) {
    std::optional<Yardstick> found;
    constexpr int kCells = 64, kMostSweeps = 160;
    for (const Measurement& fast : table.measured) {
        const int cells = fast.point.setting.cells;
        if (fast.point != Point{"B2", {SolverPreset::Fast, cells, usual_iterations(SolverPreset::Fast)}})
            continue;
        const Chosen best = front(chosen(table.measured, [&](const Measurement& m) {
            const Setting& other = m.point.setting;
            return m.point.problem == "B2" && other.method == SolverPreset::Yang2009 &&
                   other.cells == cells && other.iterations <= kMostSweeps;
        }));
        const bool better =
            !found || cells == kCells ||
            (found->fast->point.setting.cells != kCells && cells > found->fast->point.setting.cells);
        if (!best.empty() && better) found = Yardstick{&fast, best.back()};
    }
    return found;
}

std::string report_of(const Table& table) {
    std::string text = fmt::format("# What accuracy costs in time\n\n{}  \n{}\n", table.renderer,
                                   fmt::join(table.machines, "  \n"));
    if (table.machines.size() > 1)
        text += "\nTimes of different machines are mixed here: compare errors, not times.\n";
    text +=
        "\nEach point is a grid, a method, a number of iterations of the pressure and a time step. Its error "
        "is that of a "
        "flow whose\nanswer is known; its time is the wall time of a step, median of its repeats after a "
        "warm-up. ×2 means "
        "two multigrid cycles, or\nJacobi sweeps of `yang2009`, the method of the 2009 paper. Times rank "
        "methods on this "
        "machine; they do not predict another.\nErrors are the same everywhere. `accuracy.csv` has all "
        "points; `eddy "
        "accuracy --sweep` measures them.\n";
    text += in_short(table);
    for (const Problem& problem : all_problems()) {
        const Chosen measured = points_of(table, problem.name);
        if (measured.empty()) continue;
        text += fmt::format("\n## {}: {}\n\n{}\n\n![{}]({}.png)\n\n", problem.name, problem.plain,
                            problem.title, problem.plain, problem.picture);
        text += problem.thresholds.empty() ? usual_settings(problem, measured) : headline(problem, measured);
    }
    text += waste(table);
    if (std::any_of(table.measured.begin(), table.measured.end(),
                    [](const Measurement& m) { return !m.stages.empty(); }))
        text += "\n## Where the time of a step goes\n\n![time of each stage](stages.png)\n";
    text += force_ways(table);
    text +=
        "\n## What was not tried\n\nHalf precision (all of it computes in 32 bits), stopping at a tolerance "
        "(iterations "
        "are fixed), `yang2009` in A1\n(its velocities do not lie on faces). Transport and boundaries change "
        "with the "
        "method.\n";
    return text;
}

}  // namespace eddy::accuracy::sweep
