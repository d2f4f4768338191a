#include "firmware/stability/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "firmware/built_from.h"

namespace eddy::stability {
namespace {

bool is_pair(const Result& result) {
    return result.name.find('+') != std::string::npos;
}

std::string seconds_of(const std::optional<double>& seconds) {
    return seconds ? fmt::format("{:.2f}", *seconds) : "-";
}

/// "114 of 150", green of those that were tried, and how many were not.
std::string count_of(std::span<const Cell> cells, std::span<const Result> results, bool pairs) {
    long tried = 0, green = 0, all = 0;
    for (const Cell& cell : cells) all += (cell.cases.size() > 1) == pairs;
    for (const Result& result : results)
        if (is_pair(result) == pairs) {
            ++tried;
            green += result.outcome.verdict.pass;
        }
    std::string text = fmt::format("{} of {}", green, tried);
    if (tried < all) text += fmt::format(" ({} more not run)", all - tried);
    return text;
}

/// Of what another version than this has found.
std::string mark_of(const Result& result) {
    return result.tried.ends_with(fmt::format(", {}", kBuiltFrom)) ? "" : " †";
}

/// Cells of the table of one case in the report: what a reader asks of it.
std::string report_line(const Result& r) {
    const Verdict& v = r.outcome.verdict;
    return fmt::format("| {} | {} | {} | {} | {} | {} | {:.2g} | {:.3g} | {} | {} | {:.1f} | {} | {} |\n",
                       r.number, r.name, r.grid, r.effort, r.outcome.steps, v.pass ? "green" : "**red**",
                       v.kinetic_energy_ratio, v.largest_force_n, seconds_of(v.recovery_s), v.non_finite,
                       r.outcome.wall_s, r.outcome.remark, r.tried + mark_of(r));
}

/// A row for each case and a column for each grid and effort. A case about grids of its own has them in the last.
std::string overview(std::span<const Cell> cells, std::span<const Result> results) {
    std::vector<std::string> columns;
    std::vector<const Case*> rows;
    const auto column_of = [](const Cell& cell) {
        return fmt::format("{} {}", grid_name(cell.trial.cells), to_word(cell.trial.effort));
    };
    bool own_grids = false;
    for (const Cell& cell : cells) {
        if (cell.cases.size() > 1) continue;
        if (std::find(rows.begin(), rows.end(), cell.cases[0]) == rows.end()) rows.push_back(cell.cases[0]);
        own_grids |= !cell.cases[0]->grids.empty();
        if (!cell.cases[0]->grids.empty()) continue;
        if (std::find(columns.begin(), columns.end(), column_of(cell)) == columns.end())
            columns.push_back(column_of(cell));
    }
    std::string head = "| case | name |", line = "|---|---|", text;
    for (const std::string& column : columns) {
        head += fmt::format(" {} |", column);
        line += "---|";
    }
    if (own_grids) {
        head += " grids of its own |";
        line += "---|";
    }
    const auto word = [&](const Cell& cell) {
        const Result* result = find(results, cell);
        return !result ? "not run" : result->outcome.verdict.pass ? "green" : "**red**";
    };
    for (const Case* row : rows) {
        std::vector<std::string> words(columns.size());
        std::string own;
        for (const Cell& cell : cells) {
            if (cell.cases.size() > 1 || cell.cases[0] != row) continue;
            if (row->grids.empty())
                words[static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column_of(cell)) -
                                               columns.begin())] = word(cell);
            else
                own += fmt::format("{}{}: {}", own.empty() ? "" : ", ", column_of(cell), word(cell));
        }
        text += fmt::format("| {} | {} |", row->number, row->name);
        for (const std::string& one : words) text += fmt::format(" {} |", one);
        text += own_grids ? fmt::format(" {} |\n", own) : "\n";
    }
    return head + "\n" + line + "\n" + text;
}

/// What is known of the cases that are red.
std::string known_of_red(std::span<const Result> results) {
    std::string text;
    for (const Case& one : all_cases()) {
        const bool red = std::any_of(results.begin(), results.end(), [&](const Result& r) {
            return r.name == one.name && !r.outcome.verdict.pass;
        });
        if (red)
            text += fmt::format("- `{}`: {}.\n", one.name,
                                one.when_red.empty() ? "nobody has found out why yet" : one.when_red);
    }
    return text;
}

constexpr const char* kReportHead =
    "| case | name | grid | effort | steps | | energy | force [N] | calm after [s] | not finite | took [s] "
    "| figures | tried, version |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";

}  // namespace

std::string list_of(std::span<const Case> cases) {
    std::string text;
    for (const Case& one : cases) {
        text += fmt::format("{:2}  {:24} {}\n", one.number, one.name, one.title);
        text += fmt::format("    {:24} provokes: {}\n", "", one.provokes);
        if (!one.wants.empty()) text += fmt::format("    {:24} wants:    {}\n", "", one.wants);
    }
    for (const auto& [head, list] :
         {std::pair{"tried in another way", &tried_elsewhere()}, std::pair{"not offered", &not_offered()}}) {
        text += fmt::format("{}:\n", head);
        for (const NotTried& one : *list)
            text += fmt::format("{:2}  {}: {}\n", one.number, one.what, one.why);
    }
    return text;
}

std::string table_head() {
    return fmt::format("{:>4} {:32} {:10} {:8} {:>6} {:6} {:>8} {:>10} {:>8} {:>8} {:>8}\n", "case", "name",
                       "grid", "effort", "steps", "", "energy", "force N", "calm s", "bad", "took s");
}

std::string table_line(const Result& r) {
    const Verdict& v = r.outcome.verdict;
    std::string text = fmt::format(
        "{:>4} {:32} {:10} {:8} {:>6} {:6} {:>8.2g} {:>10.3g} {:>8} {:>8} {:>8.2f}\n", r.number, r.name,
        r.grid, r.effort, r.outcome.steps, v.pass ? "green" : "RED", v.kinetic_energy_ratio,
        v.largest_force_n, seconds_of(v.recovery_s), v.non_finite, r.outcome.wall_s);
    if (!v.pass) text += fmt::format("     {}\n", v.reason);
    if (!r.outcome.remark.empty()) text += fmt::format("     {}\n", r.outcome.remark);
    return text;
}

std::string summary_of(std::span<const Cell> cells, std::span<const Result> results) {
    double wall_s = 0.0;
    for (const Result& result : results) wall_s += result.outcome.wall_s;
    std::string text = fmt::format("{} cells of single cases and {} of pairs are green; took {:.0f} s\n",
                                   count_of(cells, results, false), count_of(cells, results, true), wall_s);
    const auto ended_early = std::count_if(cells.begin(), cells.end(), [&](const Cell& cell) {
        return plan_of(cell.cases, cell.trial, cell.most_steps).calm_s < kCalmS - 1e-6 && find(results, cell);
    });
    if (ended_early > 0)
        text += fmt::format(
            "not judged in {} of them: calm {} s after the last disturbance; they end before, or something "
            "disturbs "
            "to their end\n",
            ended_early, kCalmS);
    return text;
}

std::string report_of(std::span<const Cell> cells, std::span<const Result> results,
                      const std::string& renderer, const std::string& machine,
                      const std::vector<std::filesystem::path>& pictures) {
    std::string text =
        "# Hard cases\n\n"
        "What must not blow up: the cases of `eddy stability`, each on several grids, with the solver at its "
        "default effort "
        "(preset `precise`) and at its least (`fast`, one cycle). This page is written by the program; "
        "`script/report "
        "stability` makes it anew.\n\n";
    text += fmt::format(
        "{}Measured on {}; {}. Each cell says when it was tried, and by which version; until it is tried "
        "again it "
        "keeps what was found then. This page was written by version {}; † marks what another found.\n\n",
        summary_of(cells, results), renderer, machine, kBuiltFrom);
    text +=
        "A cell is green if all of this holds (`firmware/stability/rule.h`):\n\n"
        "- no texel, force or torque is nan or infinite;\n"
        "- the fluid is at most 5 times as fast as the fastest body, jet, wall or fall, times how much a gap "
        "narrows the "
        "flow;\n"
        "- kinetic energy is at most what it was at any time more than a second ago and what was done on the "
        "fluid since, with "
        "what it was given ahead of the work, and 5 % of all that it was ever given;\n"
        "- smoke and temperature stay between their extremes at the start and what sources added;\n"
        "- the hand never gets more than its limit, and the force rises no faster than the slew limit;\n"
        "- 5 s after the last disturbance the force is below 2 % of its peak, and energy is down to half in "
        "the time of "
        "friction (what ends earlier, as pairs do, or is disturbed to its end is not judged by this);\n"
        "- what the case wants besides (`eddy stability --list`).\n\n"
        "It judges fields that it downloads and forces that the hand gets; what the solver says of itself is "
        "no "
        "excuse, and a fault that it finds with itself between two looks is one more. The column "
        "energy is the largest kinetic energy as a share of what was allowed.\n\n";
    for (const std::filesystem::path& picture : pictures)
        text += fmt::format("![hard cases]({})\n\n", picture.filename().string());
    const bool any_red =
        std::any_of(results.begin(), results.end(), [](const Result& r) { return !r.outcome.verdict.pass; });
    if (any_red) {
        text += "## Red\n\n| case | name | grid | effort | why |\n|---|---|---|---|---|\n";
        for (const Result& r : results)
            if (!r.outcome.verdict.pass)
                text += fmt::format("| {} | {} | {} | {} | {}{} |\n", r.number, r.name, r.grid, r.effort,
                                    r.outcome.verdict.reason, mark_of(r));
        text += "\n" + known_of_red(results) + "\n";
    }
    text += "## All of it\n\n" + overview(cells, results) + "\n## Single cases\n\n";
    text += kReportHead;
    for (const Result& r : results)
        if (!is_pair(r)) text += report_line(r);
    text +=
        "\n## Two at once\n\nOf two cases at once only the rule is judged, not what each wants besides.\n\n";
    text += kReportHead;
    for (const Result& r : results)
        if (is_pair(r)) text += report_line(r);
    for (const auto& [head, list] :
         {std::pair{"Tried in another way", &tried_elsewhere()}, std::pair{"Not offered", &not_offered()}}) {
        text += fmt::format("\n## {}\n\n", head);
        for (const NotTried& one : *list)
            text += fmt::format("- {}, {}: {}.\n", one.number, one.what, one.why);
    }
    return text;
}

GnuplotPicture heat_map_of(std::span<const Result> results, const std::filesystem::path& folder) {
    std::vector<std::string> rows, columns;
    const auto place = [](std::vector<std::string>& names, const std::string& name) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found != names.end()) return found - names.begin();
        names.push_back(name);
        return static_cast<std::ptrdiff_t>(names.size()) - 1;
    };
    std::string green, red;
    for (const Result& r : results) {
        if (is_pair(r)) continue;
        // Cases about grids have one each, which nobody else is tried on.
        const std::string grid = r.name.starts_with("grid-") ? "own grid" : r.grid;
        const auto y = place(rows, r.name), x = place(columns, grid + " " + r.effort);
        if (r.outcome.verdict.pass)
            green +=
                fmt::format("{} {} {:.4g}\n", x, y, std::min(1.0, r.outcome.verdict.kinetic_energy_ratio));
        else
            red += fmt::format("{} {}\n", x, y);
    }
    std::string commands = fmt::format(
        "set xrange [-0.5:{}.5]\nset yrange [{}.5:-0.5]\nset cbrange [0:1]\nunset grid\nset border 0\n"
        "set palette defined (0 '#eef7ee', 1 '#2e8b3d')\nset cblabel 'kinetic energy, of what is allowed'\n"
        "set xtics rotate by 45 right\nset lmargin 26\nset bmargin 8\nunset key\n",
        columns.size() - 1, rows.size() - 1);
    const auto tics = [&](const char* axis, const std::vector<std::string>& names) {
        std::string text;
        for (std::size_t i = 0; i < names.size(); ++i)
            text += fmt::format("{}{} {}", i == 0 ? "" : ", ", in_gnuplot_quotes(names[i]), i);
        commands += fmt::format("set {} ({})\n", axis, text);
    };
    tics("xtics", columns);
    tics("ytics", rows);
    commands += "$green << EOD\n" + green + "EOD\n$red << EOD\n" + red + "EOD\n";
    std::string plots;
    if (!green.empty())
        plots += "$green using 1:2:(0.46):(0.42):3 with boxxyerror fs solid noborder lc palette";
    if (!red.empty())
        plots +=
            fmt::format("{}$red using 1:2:(0.46):(0.42) with boxxyerror fs solid noborder lc rgb '#c02020'",
                        plots.empty() ? "" : ", ");
    commands += "plot " + plots + "\n";
    return {folder / "heat_map.png", 320 + 90 * static_cast<int>(columns.size()),
            160 + 20 * static_cast<int>(rows.size()), commands};
}

}  // namespace eddy::stability
