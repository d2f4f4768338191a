#include <fmt/format.h>

#include "firmware/accuracy/sweep/plots.h"
#include "firmware/accuracy/sweep/report.h"
#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/machine.h"
#include "firmware/progress.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

namespace sweep = accuracy::sweep;
namespace fs = std::filesystem;

constexpr const char* kJson = "accuracy.json";

void write(const sweep::Table& table, const fs::path& folder) {
    replace_text_file(folder / "accuracy.csv", sweep::csv_of(table));
    replace_text_file(folder / kJson, sweep::json_of(table));
}

/// Tables, report and pictures of a whole sweep. Returns the exit status: 1 if a picture is missing.
int conclude(const sweep::Table& table, const fs::path& folder) {
    write(table, folder);
    const std::string report = sweep::report_of(table);
    replace_text_file(folder / "report.md", report);
    const std::vector<GnuplotPicture> pictures = sweep::pictures_of(table, folder);
    const std::vector<fs::path> drawn = draw_with_gnuplot(pictures);
    fmt::print("{}\nwritten to {}: accuracy.csv, accuracy.json, report.md", report, folder.string());
    for (const fs::path& picture : drawn) fmt::print(", {}", picture.filename().string());
    fmt::print("\n");
    return drawn.size() == pictures.size() ? 0 : 1;
}

/// Dear points take longer: roughly the cells they compute, once for each iteration.
double work(const sweep::Point& point) {
    const sweep::Setting& s = point.setting;
    const double n = s.cells, flat = point.problem == "A1" ? 0.25 : 1.0;
    const double of_iteration = s.method == SolverPreset::Yang2009 ? 1.0 : 5.0;
    return flat * n * n * n * (20.0 + of_iteration * s.iterations) / s.dt_factor;
}

}  // namespace

int sweep_accuracy(const AccuracyOptions& options) {
    sweep::Table table{EDDY_VERSION, {}, {describe_machine()}, {options.full, options.cases, options.grids}};
    const std::vector<sweep::Point> points = sweep::points_of(table.order);
    const sweep::Shard shard = options.shard.empty() ? sweep::Shard{} : sweep::parse_shard(options.shard);
    table.points = points.size();
    prepare_folder("--out", options.out);
    const std::unique_ptr<Graphics> graphics = open_headless();
    table.renderer = graphics->gpu.capabilities().renderer + ", " + graphics->gpu.capabilities().version;

    double total = 0.0, done = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (shard.holds(i)) total += work(points[i]);
    Progress progress("sweep");
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!shard.holds(i)) continue;
        const std::string what = fmt::format("point {} of {}, {} {}", i + 1, points.size(), points[i].problem,
                                             describe(points[i].setting));
        progress.show(done, total, what);
        table.measured.push_back(sweep::measure(graphics->gpu, points[i], i, what));
        done += work(points[i]);
    }
    progress.finish();
    if (shard.of == 1) return conclude(table, options.out);
    write(table, options.out);
    fmt::print(
        "part {} of {}, {} of {} points: written to {}; when all parts are done, put them together with\n"
        "  eddy accuracy --merge FOLDER... --out FOLDER\n",
        shard.number, shard.of, table.measured.size(), table.points, options.out);
    return 0;
}

int merge_sweeps(const std::vector<std::string>& folders, const std::string& out) {
    std::vector<sweep::Table> shards;
    for (const std::string& folder : folders) {
        const fs::path file = fs::path(folder) / kJson;
        if (!fs::exists(file)) throw InputError(fmt::format("--merge: there is no {}", file.string()));
        shards.push_back(sweep::table_from_json(read_text_file(file), file));
    }
    const sweep::Table all = sweep::merged(shards, folders);
    prepare_folder("--out", out);
    return conclude(all, out);
}

}  // namespace eddy
