#include "firmware/stability/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eddy::stability {
namespace {

std::string duration(double seconds) {
    const long minutes = std::lround(seconds / 60.0);
    if (minutes < 60) return minutes > 0 ? fmt::format("{} min", minutes) : fmt::format("{:.0f} s", seconds);
    return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace

Estimate::Estimate(gles::Gpu& gpu, std::span<const Cell> cells) {
    const Case common{.name = "common"};
    const Case* const one[] = {&common};
    for (const Cell& cell : cells) {
        const auto known = [&](const Pace& pace) { return pace.trial == cell.trial; };
        if (std::any_of(paces_.begin(), paces_.end(), known)) continue;
        const auto takes_s = [&](long steps) { return try_out(gpu, one, cell.trial, steps).wall_s; };
        // The first compiles shaders, as nearly every case has to for its own.
        const double start_s = takes_s(1), few_s = takes_s(2), more_s = takes_s(6);
        paces_.push_back({cell.trial, start_s, std::max(1e-4, (more_s - few_s) / 4.0)});
    }
}

double Estimate::seconds(const Cell& cell) const {
    const auto pace =
        std::find_if(paces_.begin(), paces_.end(), [&](const Pace& one) { return one.trial == cell.trial; });
    return pace->start_s + pace->step_s * static_cast<double>(cell.all_steps());
}

std::string Estimate::in_words(std::span<const Cell> cells) const {
    std::vector<std::pair<std::string, double>> grids;
    double all_s = 0.0;
    for (const Cell& cell : cells) {
        const std::string name = grid_name(cell.trial.cells);
        auto grid =
            std::find_if(grids.begin(), grids.end(), [&](const auto& one) { return one.first == name; });
        if (grid == grids.end()) grid = grids.emplace(grids.end(), name, 0.0);
        grid->second += seconds(cell);
        all_s += seconds(cell);
    }
    std::string text = fmt::format("about {}", duration(all_s));
    for (const auto& [name, takes_s] : grids)
        text += fmt::format("{} {} {}", &name == &grids.front().first ? ":" : ",", name, duration(takes_s));
    return text;
}

}  // namespace eddy::stability
