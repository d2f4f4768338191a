#include <fmt/format.h>

#include <algorithm>

#include "firmware/accuracy/sweep/plan.h"
#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/machine.h"
#include "firmware/progress.h"
#include "firmware/stability/report.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

using namespace stability;
namespace fs = std::filesystem;

constexpr const char* kCsv = "stability.csv";

Order order_of(const StabilityOptions& options) {
    return {options.full    ? Extent::Full
            : options.quick ? Extent::Quick
                            : Extent::Usual,
            options.cases, options.grids};
}

std::vector<Result> results_in(const fs::path& folder) {
    const fs::path file = folder / kCsv;
    return results_from_csv(read_text_file(file), file);
}

/// The exit status.
int conclude(std::span<const Result> results, const std::string& renderer, const std::string& out) {
    fmt::print("{}", summary_of(results));
    bool good =
        std::all_of(results.begin(), results.end(), [](const Result& r) { return r.outcome.verdict.pass; });
    if (out.empty()) return good ? 0 : 1;
    const fs::path folder(out);
    replace_text_file(folder / kCsv, csv_of(results));
    const std::vector<fs::path> drawn = draw_with_gnuplot({heat_map_of(results, folder)});
    replace_text_file(folder / "report.md", report_of(results, renderer, describe_machine(), drawn));
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
    return conclude(all, "the machines of its parts", options.out);
}

}  // namespace

int test_stability(const StabilityOptions& options) {
    if (options.list) {
        fmt::print("{}", list_of(all_cases()));
        return 0;
    }
    const std::vector<Cell> cells = cells_of(order_of(options));
    if (!options.merge.empty()) return merge(options, cells);
    const accuracy::sweep::Shard shard =
        options.shard.empty() ? accuracy::sweep::Shard{} : accuracy::sweep::parse_shard(options.shard);
    if (!options.out.empty()) prepare_folder("--out", options.out);
    std::vector<Result> before;
    if (options.resume && fs::exists(fs::path(options.out) / kCsv)) before = results_in(options.out);

    const std::unique_ptr<Graphics> graphics = open_headless();
    const gles::Capabilities& driver = graphics->gpu.capabilities();
    const std::string renderer = driver.renderer + ", " + driver.version;
    fmt::print("{}\n{}\n{}", renderer, describe_machine(), table_head());
    double total = 0.0, done = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (shard.holds(i)) total += cells[i].work();
    Progress progress("stability");
    std::vector<Result> results;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!shard.holds(i)) continue;
        const Cell& cell = cells[i];
        const auto known = std::find_if(before.begin(), before.end(),
                                        [&](const Result& result) { return result.is_of(cell); });
        progress.show(done, total, fmt::format("{} on {}", cell.name(), grid_name(cell.trial.cells)));
        results.push_back(known != before.end() ? *known
                                                : result_of(cell, try_out(graphics->gpu, cell.cases,
                                                                          cell.trial, cell.most_steps)));
        done += cell.work();
        progress.finish();
        fmt::print("{}", table_line(results.back()));
        std::fflush(stdout);
        if (!options.out.empty()) replace_text_file(fs::path(options.out) / kCsv, csv_of(results));
    }
    return conclude(results, renderer, options.out);
}

}  // namespace eddy
