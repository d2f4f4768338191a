#include <fmt/format.h>

#include "config/scene.h"
#include "firmware/graphics.h"
#include "firmware/progress.h"
#include "firmware/stability/long_run.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

using stability::LongRunSample;

void print(const std::vector<LongRunSample>& samples) {
    fmt::print("{:>10}{:>14}{:>12}{:>14}{:>14}{:>12}{:>13}{:>14}{:>10}\n", "steps", "mean p [Pa]",
               "smoke [m3]", "energy [J]", "force [N]", "sent [N]", "memory [MiB]", "textures [MiB]",
               "objects");
    for (const LongRunSample& s : samples)
        fmt::print("{:>10}{:>14.3g}{:>12.4g}{:>14.3g}{:>14.3g}{:>12.4g}{:>13.2f}{:>14.2f}{:>10}\n", s.steps,
                   s.pressure_mean_pa, s.smoke_total_m3, s.kinetic_energy_j, s.force_mean_n, s.sent_mean_n,
                   s.memory_mib, s.texture_mib, s.textures_made + s.programs + s.framebuffers);
}

}  // namespace

int run_endlessly(const StabilityOptions& options) {
    const Scene scene = load_scene(options.scene, options.set).scene;
    const std::unique_ptr<Graphics> graphics = open_headless();
    fmt::print(
        "{}, {}x{}x{} cells, steps of {} s\nforces and what is sent: means over two minutes of the scene\n",
        scene.title, scene.tank.cells.x, scene.tank.cells.y, scene.tank.cells.z, scene.solver.dt_s);
    bool flat = true;
    for (const stability::Visitor visitor : {stability::Visitor::None, stability::Visitor::Stirs}) {
        const bool stirs = visitor == stability::Visitor::Stirs;
        fmt::print("\n{}\n", stirs ? "Somebody stirs:" : "Nobody is there:");
        Progress progress("endless");
        const std::vector<LongRunSample> samples =
            stability::long_run(graphics->gpu, scene, visitor, *options.endless, [&](long step) {
                progress.show(static_cast<double>(step), static_cast<double>(*options.endless));
            });
        progress.finish();
        print(samples);
        for (const std::string& drift : stability::drifts(samples)) {
            fmt::print("drifts: {}\n", drift);
            flat = false;
        }
    }
    fmt::print("\n{}\n", flat ? "Nothing drifts." : "Something drifts.");
    return flat ? 0 : 1;
}

}  // namespace eddy
