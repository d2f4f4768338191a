#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "firmware/accuracy/sweep/plan.h"
#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/machine.h"
#include "firmware/progress.h"
#include "firmware/stability/estimate.h"
#include "firmware/stability/long_run_report.h"
#include "firmware/stability/report.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

using namespace stability;
namespace fs = std::filesystem;

constexpr const char* kCsv = "stability.csv";

Order order_of(const StabilityOptions& options) {
    return {options.full    ? stability::Extent::Full
            : options.quick ? stability::Extent::Quick
                            : stability::Extent::Usual,
            options.cases, options.grids};
}

std::vector<Result> results_in(const fs::path& folder) {
    const fs::path file = folder / kCsv;
    return results_from_csv(read_text_file(file), file);
}

/// The exit status.
int conclude(std::span<const Cell> cells, std::span<const Result> results, const std::string& renderer,
             const std::string& out) {
    fmt::print("{}", summary_of(cells, results));
    bool good =
        results.size() == cells.size() &&
        std::all_of(results.begin(), results.end(), [](const Result& r) { return r.outcome.verdict.pass; });
    if (out.empty()) return good ? 0 : 1;
    const fs::path folder(out);
    replace_text_file(folder / kCsv, csv_of(results));
    const std::vector<fs::path> drawn = draw_with_gnuplot({heat_map_of(results, folder)});
    std::string report = report_of(cells, results, renderer, describe_machine(), drawn);
    if (const fs::path file = folder / kLongRunsCsv; fs::exists(file))
        report += report_of(long_runs_from_csv(read_text_file(file), file));
    replace_text_file(folder / "report.md", report);
    fmt::print("written to {}: {}, report.md{}\n", out, kCsv, drawn.empty() ? "" : ", heat_map.png");
    return good && !drawn.empty() ? 0 : 1;
}

int merge(const StabilityOptions& options, std::span<const Cell> cells) {
    std::vector<std::vector<Result>> parts;
    for (const std::string& folder : options.merge) {
        if (!fs::exists(fs::path(folder) / kCsv))
            throw InputError(fmt::format("--merge: there is no {}", (fs::path(folder) / kCsv).string()));
        parts.push_back(results_in(folder));
    }
    const std::vector<Result> all = merged(cells, parts);
    prepare_folder("--out", options.out);
    return conclude(cells, all, "the machines of its parts", options.out);
}

/// Tries those of the cells that are not known yet, grid by grid. All results, in the order of the cells.
std::vector<Result> try_all(gles::Gpu& gpu, const std::vector<Cell>& cells, const std::vector<Result>& before,
                            const std::function<void(std::span<const Result>)>& on_result) {
    std::vector<Result> results = merged(cells, std::array{before});
    std::vector<Cell> left;
    for (const Cell& cell : cells)
        if (!find(results, cell)) left.push_back(cell);
    const Estimate estimate(gpu, left);
    fmt::print("{} of {} cells to be tried, {}\n{}", left.size(), cells.size(), estimate.in_words(left),
               table_head());
    for (const Result& known : results) fmt::print("{}", table_line(known));
    std::fflush(stdout);
    double total_s = 0.0, done_s = 0.0;
    for (const Cell& cell : left) total_s += estimate.seconds(cell);
    Progress progress("stability");
    while (!left.empty()) {
        const std::vector<std::size_t> order = telling_first(left, results);
        const Cell first = left[order.front()];
        const auto goes_with_first = [&](const Cell& cell) {
            return cell.trial.cells == first.trial.cells && cell.cases.size() == first.cases.size();
        };
        for (const std::size_t i : order) {
            const Cell& cell = left[i];
            if (!goes_with_first(cell)) break;
            progress.show(done_s, total_s, fmt::format("{} on {}", cell.name(), grid_name(first.trial.cells)));
            results.push_back(result_of(cell, try_out(gpu, cell.cases, cell.trial, cell.most_steps)));
            done_s += estimate.seconds(cell);
            progress.finish();
            fmt::print("{}", table_line(results.back()));
            std::fflush(stdout);
            on_result(results);
        }
        std::erase_if(left, goes_with_first);
    }
    return merged(cells, std::array{results});
}

}  // namespace

int test_stability(const StabilityOptions& options) {
    if (options.list) {
        fmt::print("{}", list_of(all_cases()));
        return 0;
    }
    const std::vector<Cell> all = cells_of(order_of(options));
    if (!options.merge.empty()) return merge(options, all);
    const accuracy::sweep::Shard shard =
        options.shard.empty() ? accuracy::sweep::Shard{} : accuracy::sweep::parse_shard(options.shard);
    if (!options.out.empty()) prepare_folder("--out", options.out);
    std::vector<Result> before;
    if (options.resume && fs::exists(fs::path(options.out) / kCsv)) before = results_in(options.out);
    // Dealt out among those that take equally long.
    const std::vector<std::size_t> dealt = telling_first(all, {});
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < dealt.size(); ++i)
        if (shard.holds(i)) cells.push_back(all[dealt[i]]);

    const std::unique_ptr<Graphics> graphics = open_headless();
    const gles::Capabilities& driver = graphics->gpu.capabilities();
    const std::string renderer = driver.renderer + ", " + driver.version;
    fmt::print("{}\n{}\n", renderer, describe_machine());
    const std::vector<Result> results =
        try_all(graphics->gpu, cells, before, [&](std::span<const Result> so_far) {
            if (!options.out.empty()) replace_text_file(fs::path(options.out) / kCsv, csv_of(so_far));
        });
    return conclude(cells, results, renderer, options.out);
}

}  // namespace eddy
