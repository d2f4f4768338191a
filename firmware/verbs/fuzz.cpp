#include <fmt/format.h>

#include <algorithm>

#include "firmware/destination.h"
#include "firmware/graphics.h"
#include "firmware/progress.h"
#include "firmware/stability/fuzz.h"
#include "firmware/stability/hand_fuzz.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

std::vector<std::string> joined(std::vector<std::string> first, const std::vector<std::string>& more) {
    first.insert(first.end(), more.begin(), more.end());
    return first;
}

}  // namespace

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

int fuzz_hands(const StabilityOptions& options) {
    constexpr Seconds kDuration{4.0};
    // Coarse, if nobody says otherwise: what the hand gets hangs on the loop, not on the grid.
    const Scene scene = options.scene.empty()
                            ? load_scene("stir", joined({"tank.cells=[8, 8, 8]"}, options.set)).scene
                            : load_scene(options.scene, options.set).scene;
    const std::unique_ptr<Graphics> graphics = open_headless();
    fmt::print("{}\n", graphics->gpu.capabilities().renderer);
    Progress progress("hands");
    int found = 0;
    double most_n = 0.0;
    for (int i = 0; i < *options.hands; ++i) {
        const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
        progress.show(i, *options.hands, fmt::format("seed {}", seed));
        const stability::HandFuzzFigures figures =
            stability::play_random_hand(graphics->gpu, scene, seed, kDuration);
        most_n = std::max(most_n, figures.most_n);
        if (figures.violation.empty()) continue;
        ++found;
        progress.finish();
        fmt::print("seed {}: {}\n", seed, figures.violation);
    }
    progress.finish();
    fmt::print("{} of {} random hands, {} s each, broke the rule; at most {:.3g} N were sent\n", found,
               *options.hands, kDuration.count(), most_n);
    return found == 0 ? 0 : 1;
}

}  // namespace eddy
