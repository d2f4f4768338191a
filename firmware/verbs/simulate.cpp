#include <fmt/format.h>

#include <cmath>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "firmware/body_schedule.h"
#include "firmware/destination.h"
#include "firmware/fluid_setup.h"
#include "firmware/force_comparison.h"
#include "firmware/graphics.h"
#include "firmware/npy.h"
#include "firmware/plan.h"
#include "firmware/probes.h"
#include "firmware/progress.h"
#include "firmware/series.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"
#include "firmware/vorticity.h"
#include "gles/fluid/fluid.h"
#include "gles/grid_io.h"

namespace eddy {
namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// What the whole run came to, for summary.json and the terminal.
struct Summary {
    long steps = 0;
    double seconds = 0.0;  // simulated
    double wall_s = 0.0;
    double divergence_cut = 0.0;  // least factor by which a step cut max |div u|
    gles::StepResult last;
    std::optional<ForceComparison> forces;  // where the scene asks for force_methods
};

void add_to(Summary& summary, const gles::StepResult& result) {
    ++summary.steps;
    summary.last = result;
    const gles::Diagnostics& d = *result.diagnostics;
    if (d.divergence_max_1_s <= 0.0) return;
    const double cut = d.divergence_before_1_s / d.divergence_max_1_s;
    summary.divergence_cut = summary.divergence_cut > 0.0 ? std::min(summary.divergence_cut, cut) : cut;
}

std::string to_json(const Summary& s, const LoadedScene& loaded, const gles::Gpu& gpu) {
    nlohmann::ordered_json j;
    j["title"] = loaded.scene.title;
    j["renderer"] = gpu.capabilities().renderer;
    j["gl_version"] = gpu.capabilities().version;
    j["eddy_version"] = EDDY_VERSION;
    j["steps"] = s.steps;
    j["simulated_s"] = s.seconds;
    j["wall_s"] = s.wall_s;
    if (!loaded.scene.imposed) j["least_divergence_cut"] = s.divergence_cut;
    for (std::size_t i = 0; i < loaded.scene.bodies.size(); ++i) {
        const gles::Load& load = s.last.loads[i];
        j["bodies"].push_back({{"name", loaded.scene.bodies[i].name},
                               {"last_force_n", {load.force_n.x, load.force_n.y, load.force_n.z}},
                               {"last_torque_nm", {load.torque_nm.x, load.torque_nm.y, load.torque_nm.z}}});
        if (!s.forces || !s.forces->spread(i)) continue;
        j["bodies"].back()["force_methods"] = {{"spread_over_force", *s.forces->spread(i)},
                                               {"transport_over_force", *s.forces->transport(i)}};
    }
    if (s.last.diagnostics) {
        j["kinetic_energy_j"] = s.last.diagnostics->kinetic_energy_j;
        j["divergence_max_1_s"] = s.last.diagnostics->divergence_max_1_s;
        j["smoke_total"] = s.last.diagnostics->smoke_total;
        if (loaded.scene.temperature) j["temperature_total_k_m3"] = s.last.diagnostics->temperature_total;
    }
    return j.dump(2) + "\n";
}

void write_fields(const std::filesystem::path& out, const Scene& scene, const gles::Fluid& fluid) {
    const glm::ivec3 n = scene.tank.cells;
    for (const OutputField field : scene.outputs.fields) {
        if (field == OutputField::Velocity) {
            const std::vector<glm::vec3> u = fluid.velocity();
            const int extra = static_cast<int>(u.size()) == n.x * n.y * n.z ? 0 : 1;  // faces: one layer more
            write_npy(out / "velocity.npy", {&u[0].x, 3 * u.size()},
                      {n.z + extra, n.y + extra, n.x + extra, 3});
        } else if (field == OutputField::Vorticity) {
            const std::vector<glm::vec3> curl = vorticity(fluid.velocity(), n, scene.tank.cell_m());
            write_npy(out / "vorticity.npy", {&curl[0].x, 3 * curl.size()}, {n.z, n.y, n.x, 3});
        } else if (field == OutputField::Pressure) {
            write_npy(out / "pressure.npy", fluid.pressure(), {n.z, n.y, n.x});
        } else {
            const bool is_smoke = field == OutputField::Smoke;
            const gles::Field<gles::Cells>& scalar = is_smoke ? *fluid.smoke() : *fluid.temperature();
            write_npy(out / (is_smoke ? "smoke.npy" : "temperature.npy"),
                      gles::unpack_scalars(scalar.texture().download(), scalar.layout()), {n.z, n.y, n.x});
        }
    }
}

/// At least one: a run of none has no last step to report.
long steps_of(const SimulateOptions& options, const Scene& scene) {
    if (options.steps) return *options.steps;
    const double seconds = options.seconds.value_or(scene.outputs.duration_s), dt = scene.solver.dt_s;
    if (seconds < 0.5 * dt)
        throw InputError(fmt::format("{}: {} s is less than half a step of solver.dt_s = {} s",
                                     options.seconds ? "--seconds" : "outputs.duration_s", seconds, dt));
    return std::lround(seconds / dt);
}

}  // namespace

int simulate(const SimulateOptions& options) {
    const LoadedScene loaded = load_scene(options.scene, options.set);
    const Scene& scene = loaded.scene;
    const BodySchedule motions(scene);
    const gles::FluidSetup setup = fluid_setup(scene);
    const double dt = scene.solver.dt_s;
    const long steps = steps_of(options, scene);
    if (!options.out.empty() && !options.plan) prepare_folder("--out", options.out);
    const std::unique_ptr<Graphics> graphics = open_headless();
    if (options.plan) {
        fmt::print("{}", plan_of(graphics->gpu, setup, motions, dt));
        return 0;
    }

    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(graphics->gpu, setup);
    const Probes probes(scene);
    std::optional<Series> series;
    if (!options.out.empty()) {
        std::vector<std::string> names;
        for (const Scene::Body& body : scene.bodies) names.push_back(body.name);
        Series::More more;
        if (setup.force_methods) more.of_each_body = ForceComparison::columns();
        if (scene.temperature) more.of_all.emplace_back("temperature_total_k_m3");
        for (std::string& column : probes.columns()) more.of_all.push_back(std::move(column));
        if (scene.outputs.series)
            series.emplace(std::filesystem::path(options.out) / "series.csv", names, more);
    }

    Summary summary;
    if (setup.force_methods) summary.forces.emplace(scene.bodies.size());
    Progress progress("simulate");
    const auto start = std::chrono::steady_clock::now();
    for (long n = 1; n <= steps; ++n) {
        const auto step_start = std::chrono::steady_clock::now();
        const double t = static_cast<double>(n) * dt;
        fluid->step(dt, motions.at(t, dt), true);
        const gles::StepResult result = fluid->wait_result();
        if (!std::isfinite(result.diagnostics->kinetic_energy_j))
            throw std::runtime_error(
                fmt::format("the flow has no finite value after step {} of {}: look for a formula without a "
                            "value somewhere in the "
                            "tank (1/x, sqrt of a negative number), or a scene that no flow can follow",
                            n, steps));
        add_to(summary, result);
        if (summary.forces) summary.forces->add(result.loads, fluid->force_methods());
        if (series) {
            Series::MoreValues more;
            for (const gles::ForceMethods& methods : fluid->force_methods())
                more.of_each_body.push_back(ForceComparison::values(methods));
            if (scene.temperature) more.of_all.push_back(result.diagnostics->temperature_total);
            const double step_ms = milliseconds_since(step_start);
            for (const double value : probes.read(*fluid)) more.of_all.push_back(value);
            series->add(t, result, fluid->bodies(), step_ms, more);
        }
        progress.show(static_cast<double>(n), static_cast<double>(steps));
    }
    progress.finish();
    summary.seconds = static_cast<double>(steps) * dt;
    summary.wall_s = milliseconds_since(start) / 1e3;

    fmt::print("{}: {} steps of {} s on {}\n", scene.title.empty() ? options.scene : scene.title,
               summary.steps, dt, graphics->gpu.capabilities().renderer);
    fmt::print("{:.1f} steps/s", static_cast<double>(steps) / summary.wall_s);
    if (!scene.imposed)
        fmt::print("; each step cut the divergence by a factor of {:.0f} or more", summary.divergence_cut);
    fmt::print("\n");
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const glm::dvec3 f = summary.last.loads[i].force_n;
        fmt::print("force on {} at the end: ({:.4e}, {:.4e}, {:.4e}) N\n", scene.bodies[i].name, f.x, f.y,
                   f.z);
        const std::optional<double> spread = summary.forces ? summary.forces->spread(i) : std::nullopt;
        if (spread) fmt::print("measured three ways it agrees within {:.2g} of it\n", *spread);
    }
    if (!options.out.empty()) {
        const std::filesystem::path out(options.out);
        if (series) series->finish();
        write_fields(out, scene, *fluid);
        replace_text_file(out / "summary.json", to_json(summary, loaded, graphics->gpu));
        fmt::print("written to {}\n", options.out);
    }
    return 0;
}

}  // namespace eddy
