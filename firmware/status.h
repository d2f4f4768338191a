#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/cost_figures.h"
#include "firmware/exhibit/vital_signs.h"
#include "firmware/haptic/exchange.h"
#include "firmware/show.h"

namespace eddy {

/// What status.json says: enough for someone who cannot see the screen to tell whether the exhibit is well.
struct Status {
    std::string scene, renderer, display, haptic_device;
    double uptime_s = 0.0;
    ShowFigures show;
    gles::GuardCounts guards;
    LoopReport loop;
    CostFigures cost;
    struct Gain {
        double now = 0.0, of_scene = 0.0;
        long changes = 0;
    } gain;
    std::uint64_t flights = 0;  ///< faults of which the seconds before were kept
    VitalSigns vital_signs{};
};

/// What one guard did, under the name that status.json and the metrics give it.
struct GuardFigure {
    std::string_view name;
    long count = 0;
};
std::vector<GuardFigure> guard_figures(const Status& status);

/// Replaces the file in one step. A disk that is full or gone must not stop the show: returns false then.
bool write_status(const std::filesystem::path& file, const Status& status);

}  // namespace eddy
