#include "firmware/accuracy/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "firmware/accuracy/convergence.h"
#include "firmware/scene_grid.h"
#include "firmware/stopwatch.h"

namespace eddy::accuracy {
namespace {

double power_of_h(TimeStep rule) {
    switch (rule) {
        case TimeStep::Same:
            return 0.0;
        case TimeStep::Courant:
            return 1.0;
        case TimeStep::Diffusion:
            return 2.0;
    }
    throw std::logic_error("a time step without a rule");
}

Row measure(gles::Gpu& gpu, const Case& one, int cells) {
    const auto start = std::chrono::steady_clock::now();
    Laboratory lab(gpu, scene_on_grid(one, cells), fmt::format("{} with {} cells", one.name, cells));
    const Scene& scene = lab.scene();
    Row row{.cells = scene.tank.cells, .cell_m = scene.tank.cell_m(), .dt_s = scene.solver.dt_s};
    for (const double value : one.measure(lab)) row.readings.push_back({.measured = value});
    if (row.readings.size() != one.quantities.size())
        throw std::logic_error(fmt::format("case {} measures {} quantities of {}", one.name,
                                           row.readings.size(), one.quantities.size()));
    row.steps = static_cast<long>(lab.step_ms().size());
    row.step_ms = median(lab.step_ms());
    row.total_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return row;
}

}  // namespace

Scene scene_on_grid(const Case& one, int cells, std::string_view asked_by) {
    const Scene written = load_scene(one.scene, one.set).scene;
    Scene scene = with_longest_side(written, cells, asked_by);
    const double finer = written.tank.cell_m() / scene.tank.cell_m();
    const double dt = written.solver.dt_s / std::pow(finer, power_of_h(one.time_step));
    const double part_s = scene.outputs.duration_s / one.parts;
    scene.solver.dt_s = part_s / std::max(1.0, std::round(part_s / dt));
    return scene;
}

double error_of(const Quantity& quantity, double measured) {
    const double difference = std::abs(measured - quantity.exact);
    switch (quantity.error) {
        case Quantity::Error::Relative:
            return difference / std::abs(quantity.exact);
        case Quantity::Error::Absolute:
            return difference;
        case Quantity::Error::Shortfall:
            return measured >= quantity.exact ? 0.0 : difference;
    }
    throw std::logic_error("an error without a rule");
}

std::optional<double> limit_on(const Quantity& quantity, int cells) {
    std::optional<double> limit;
    for (const Limit& one : quantity.limits)
        if (cells >= one.cells) limit = one.error;
    return limit;
}

void judge(const Case& one, std::vector<Row>& rows) {
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t q = 0; q < one.quantities.size(); ++q) {
            const Quantity& quantity = one.quantities[q];
            const glm::ivec3& n = rows[r].cells;
            Reading& reading = rows[r].readings[q];
            reading.error = error_of(quantity, reading.measured);
            if (quantity.estimates_error) {
                reading.covers = reading.measured >= rows[r].readings.at(q - 1).error;
                continue;
            }
            reading.limit = limit_on(quantity, std::max({n.x, n.y, n.z}));
            if (r > 0)
                reading.order = observed_order(rows[r - 1].readings[q].error, reading.error,
                                               rows[r - 1].cell_m, rows[r].cell_m);
            if (r > 0 && r + 1 == rows.size()) reading.least_order = quantity.least_order;
            if (!reading.limit && !reading.least_order) continue;
            // What is not a number is a miss.
            const bool good =
                (!reading.limit || reading.error <= *reading.limit) &&
                (!reading.least_order || (reading.order && *reading.order >= *reading.least_order));
            reading.verdict = good ? Verdict::Met : Verdict::Missed;
        }
}

Study study(gles::Gpu& gpu, const Case& one, std::vector<int> grids) {
    std::sort(grids.begin(), grids.end());
    grids.erase(std::unique(grids.begin(), grids.end()), grids.end());
    Study result{&one, {}};
    for (const int cells : grids) result.rows.push_back(measure(gpu, one, cells));
    judge(one, result.rows);
    return result;
}

bool missed(const Study& study) {
    for (const Row& row : study.rows)
        for (const Reading& reading : row.readings)
            if (reading.verdict == Verdict::Missed) return true;
    return false;
}

}  // namespace eddy::accuracy
