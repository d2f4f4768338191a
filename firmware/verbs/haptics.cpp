#include <fmt/format.h>

#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/haptic_study/report.h"
#include "firmware/machine.h"
#include "firmware/progress.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

using namespace haptic_study;
namespace fs = std::filesystem;

int study_haptics(const HapticsOptions& options) {
    StudyOrder order;
    order.cells = options.cells;
    if (!options.scenes.empty()) order.scenes = options.scenes;
    if (options.quick) order.scenes.clear();
    if (!options.out.empty()) prepare_folder("--out", options.out);
    std::string machine = describe_machine();
    std::unique_ptr<Graphics> graphics;
    if (!order.scenes.empty()) {
        graphics = open_headless();
        const gles::Capabilities& driver = graphics->gpu.capabilities();
        machine += fmt::format(", {}, {}", driver.renderer, driver.version);
    }
    Progress progress("haptics");
    const Study found = study(graphics ? &graphics->gpu : nullptr, order,
                              [&progress](double done, double total, const std::string& what) {
                                  progress.show(done, total, what);
                              });
    progress.finish();
    fmt::print("{}\n{}", machine, summary_of(found));
    if (options.out.empty()) return 0;
    const fs::path folder(options.out);
    replace_text_file(folder / "haptics.csv", csv_of(found));
    const std::vector<GnuplotPicture> pictures = pictures_of(found, folder);
    const std::vector<fs::path> drawn = draw_with_gnuplot(pictures);
    replace_text_file(folder / "report.md", report_of(found, order, machine, drawn));
    fmt::print("written to {}: haptics.csv, report.md", options.out);
    for (const fs::path& picture : drawn) fmt::print(", {}", picture.filename().string());
    fmt::print("\n");
    return drawn.size() == pictures.size() ? 0 : 1;
}

}  // namespace eddy
