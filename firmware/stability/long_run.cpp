#include "firmware/stability/long_run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "firmware/stability/stepped_exhibit.h"
#include "gles/grid_io.h"
#include "hal/haptic/emulated/make_emulated_falcon.h"
#include "hal/haptic/emulated/person_motion.h"

namespace eddy::stability {
namespace {

constexpr Seconds kVisit{120.0};  ///< after which PersonMotion repeats
/// Means over a whole visit may differ by this share of the greatest: the flow is never twice the same.
constexpr double kForceDrift = 0.05;
constexpr double kMemoryDriftMib = 1.0;
/// The mean pressure of a closed tank is put back to 0 in each step (gles/fluid/pressure_level.h): what is left is noise about 0,
/// and no share of itself. It may change by this share of rho (L / dt)^2, twice the pressure at which the guard `pocket` sets in
/// (gles/guard.glsl). In 16 cm of water and steps of 20 ms that is 6 Pa, 10 mN on the side of a body of 4 cm; a hand that stirs
/// makes noise of 4e-6.
constexpr double kPressureDrift = 1e-4;

double resident_mib() {
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

double sum(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The sums over the steps since the last sample.
struct Sums {
    long steps = 0, ticks = 0;
    double force_n = 0.0, sent_n = 0.0;
};

LongRunSample sample(gles::Gpu& gpu, const Show& show, double dt_s, const Sums& sums) {
    const gles::Fluid& fluid = show.fluid();
    const double volume_m3 = std::pow(fluid.setup().cell_m, 3);
    LongRunSample s;
    s.steps = show.figures().steps;
    const std::vector<float> p = fluid.pressure();
    s.pressure_mean_pa = sum(p) / static_cast<double>(p.size());
    const glm::ivec3 n = fluid.setup().cells;
    const double crosses_m_s = fluid.setup().cell_m * std::max({n.x, n.y, n.z}) / dt_s;
    s.pressure_scale_pa = fluid.setup().density_kg_m3 * crosses_m_s * crosses_m_s;
    if (const gles::Field<gles::Cells>* smoke = fluid.smoke())
        s.smoke_total_m3 =
            volume_m3 * sum(gles::unpack_scalars(smoke->texture().download(), smoke->layout()));
    for (const glm::vec3& u : fluid.velocity())
        s.kinetic_energy_j +=
            0.5 * fluid.setup().density_kg_m3 * volume_m3 * static_cast<double>(glm::dot(u, u));
    s.force_mean_n = sums.force_n / static_cast<double>(std::max(1L, sums.steps));
    s.sent_mean_n = sums.sent_n / static_cast<double>(std::max(1L, sums.ticks));
    s.memory_mib = resident_mib();
    s.texture_mib = static_cast<double>(gpu.textures().bytes()) / (1024.0 * 1024.0);
    s.textures_made = gpu.textures().made();
    s.programs = gpu.programs().linked();
    s.framebuffers = gpu.framebuffers();
    return s;
}

}  // namespace

std::vector<LongRunSample> long_run(gles::Gpu& gpu, const Scene& scene, Visitor visitor, long steps,
                                    const std::function<void(long step)>& on_step) {
    const std::unique_ptr<HapticDevice> hand =
        visitor == Visitor::Stirs ? emulated::make_emulated_falcon(
                                        std::make_unique<emulated::PersonMotion>(emulated::PersonSettings{}))
                                  : nullptr;
    SteppedExhibit exhibit(gpu, scene, hand.get());

    const Instant period = std::chrono::duration_cast<Instant>(Seconds(scene.solver.dt_s));
    const long a_visit = std::lround(kVisit / Seconds(scene.solver.dt_s));
    std::vector<LongRunSample> samples;
    Sums sums;
    Instant tick{0};
    for (long step = 1; step <= steps; ++step) {
        const Instant now = step * period;
        for (; tick < now; tick += kTick) exhibit.tick(tick);
        exhibit.update(now, Seconds(scene.solver.dt_s));
        sums.force_n += glm::length(exhibit.answer().force_n);
        ++sums.steps;
        for (const TickRecord& record : exhibit.ticks()) {
            sums.sent_n += glm::length(record.sent_force_n);
            ++sums.ticks;
        }
        if (step % a_visit == 0) {
            if (step > a_visit) samples.push_back(sample(gpu, exhibit.show(), scene.solver.dt_s, sums));
            sums = {};
        }
        if (on_step) on_step(step);
    }
    return samples;
}

std::vector<std::string> drifts(const std::vector<LongRunSample>& samples) {
    if (samples.size() < 2) return {"there are not two samples to compare: run for longer"};
    const LongRunSample &first = samples.front(), &last = samples.back();
    std::vector<std::string> found;
    double most_n = 0.0, most_sent_n = 0.0;
    for (const LongRunSample& s : samples) {
        if (!std::isfinite(s.pressure_mean_pa + s.smoke_total_m3 + s.kinetic_energy_j + s.force_mean_n))
            found.push_back(fmt::format("after {} steps something is not a number", s.steps));
        most_n = std::max(most_n, s.force_mean_n);
        most_sent_n = std::max(most_sent_n, s.sent_mean_n);
    }
    const auto compare = [&](const char* what, double before, double after, double allowed) {
        if (!(std::abs(after - before) <= allowed))
            found.push_back(fmt::format("{}: {:.4g}, then {:.4g}", what, before, after));
    };
    compare("mean pressure [Pa]", first.pressure_mean_pa, last.pressure_mean_pa,
            kPressureDrift * last.pressure_scale_pa);
    compare("mean force [N]", first.force_mean_n, last.force_mean_n, kForceDrift * most_n);
    compare("mean force on the hand [N]", first.sent_mean_n, last.sent_mean_n, kForceDrift * most_sent_n);
    compare("memory [MiB]", first.memory_mib, std::max(first.memory_mib, last.memory_mib), kMemoryDriftMib);
    const auto same = [&](const char* what, std::size_t before, std::size_t after) {
        if (before != after) found.push_back(fmt::format("{}: {}, then {}", what, before, after));
    };
    same("textures made", first.textures_made, last.textures_made);
    same("programs", first.programs, last.programs);
    same("framebuffers", first.framebuffers, last.framebuffers);
    return found;
}

}  // namespace eddy::stability
