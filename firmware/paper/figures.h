#pragma once
#include <filesystem>

#include "firmware/paper/force_cost.h"

namespace eddy::paper {

/// A row of Table I.
struct Implementation {
    std::string name, grid;
    double updates_per_s;
    std::string hardware;
};

/// What the paper prints, on the hardware it names; the other two rows it quotes name none.
const std::vector<Implementation>& published();

/// Draws figures 8, 9 and 10 into `folder` as PNG, with the figures they show beside them as paper.csv, and the page that
/// explains them, paper.md. False if a figure is missing.
bool draw_figures(const std::filesystem::path& folder, const std::vector<ForceCost>& costs,
                  const std::vector<Implementation>& ours, const std::string& renderer, CostClock clock);

}  // namespace eddy::paper
