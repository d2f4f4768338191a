#include <fmt/format.h>

#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/progress.h"
#include "firmware/stability/fuzz.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

int fuzz_scenes(const StabilityOptions& options) {
    stability::FuzzPlan plan{.first_seed = options.seed, .scenes = *options.fuzz};
    plan.folder = options.out.empty() ? "." : options.out;
    if (!options.out.empty()) prepare_folder("--out", options.out);
    const std::unique_ptr<Graphics> graphics = open_headless();
    fmt::print("{}\n", graphics->gpu.capabilities().renderer);
    Progress progress("fuzz");
    const std::vector<stability::FuzzFinding> findings =
        stability::fuzz(graphics->gpu, plan, [&](std::uint64_t seed) {
            progress.show(static_cast<double>(seed - plan.first_seed), plan.scenes,
                          fmt::format("seed {}", seed));
        });
    progress.finish();
    for (const stability::FuzzFinding& finding : findings)
        fmt::print("seed {}: {}\n  what is left of it: {}\n", finding.seed, finding.violation,
                   finding.file.string());
    fmt::print("{} of {} random scenes, {} steps each, broke the rule\n", findings.size(), plan.scenes,
               plan.steps);
    return findings.empty() ? 0 : 1;
}

}  // namespace eddy
