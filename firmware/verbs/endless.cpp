#include <fmt/format.h>

#include "config/scene.h"
#include "firmware/built_from.h"
#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/machine.h"
#include "firmware/progress.h"
#include "firmware/stability/long_run_report.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

int run_endlessly(const StabilityOptions& options) {
    using namespace stability;
    const Scene scene = load_scene(options.scene.empty() ? "stir" : options.scene, options.set).scene;
    if (!options.out.empty()) prepare_folder("--out", options.out);
    const std::unique_ptr<Graphics> graphics = open_headless();
    const std::string what = fmt::format("{}, {}x{}x{} cells, steps of {} s", scene.title, scene.tank.cells.x,
                                         scene.tank.cells.y, scene.tank.cells.z, scene.solver.dt_s);
    fmt::print("{}\nforces and what is sent: means over two minutes of the scene\n", what);
    std::vector<LongRun> runs;
    bool flat = true;
    for (const Visitor visitor : {Visitor::None, Visitor::Stirs}) {
        const std::string who = visitor == Visitor::Stirs ? "somebody stirs" : "nobody is there";
        fmt::print("\n{}:\n", who);
        Progress progress("endless");
        const std::vector<LongRunSample> samples =
            long_run(graphics->gpu, scene, visitor, *options.endless, [&](long step) {
                progress.show(static_cast<double>(step), static_cast<double>(*options.endless));
            });
        progress.finish();
        fmt::print("{}", table_of(samples));
        for (const std::string& drift : drifts(samples)) {
            fmt::print("drifts: {}\n", drift);
            flat = false;
        }
        runs.push_back({fmt::format("{}, {} ({}, {})", what, who, date_and_time(), kBuiltFrom), samples});
        if (!options.out.empty())
            replace_text_file(std::filesystem::path(options.out) / kLongRunsCsv, csv_of(runs));
    }
    fmt::print("\n{}\n", flat ? "Nothing drifts." : "Something drifts.");
    return flat ? 0 : 1;
}

}  // namespace eddy
