#pragma once
#include <functional>
#include <string>
#include <vector>

#include "firmware/haptic_study/trials.h"

namespace eddy::haptic_study {

/// What is to be tried.
struct StudyOrder {
    std::vector<std::string> scenes{"stir", "jet"};  ///< shipped, or files; with a body in the hand
    int cells = 24;                                  ///< along the longest side of their tanks
};

inline constexpr double kRatesHz[] = {20.0, 30.0, 50.0, 75.0};
inline constexpr ForceLaw kLaws[] = {ForceLaw::Filter, ForceLaw::Model};
/// The fluid of a known drag and added mass that every study begins with.
inline constexpr const char* kKnown = "known";
inline constexpr KnownFluid::Settings kKnownFluid{.drag_ns_m = 1.5, .added_kg = 0.07};

const char* to_string(ForceLaw law);

struct CircleRow {
    std::string fluid;
    ForceLaw law;
    double rate_hz;
    CircleFigures figures;
};
struct StirRow {
    std::string fluid;
    ForceLaw law;
    double rate_hz, stir_hz;
    StirFigures figures;
};
struct SwingRow {
    std::string fluid;
    ForceLaw law;
    double rate_hz;
    Holder holder;
    double stir_hz;  ///< of the circle out of which it was let go
    Swing swing;
    /// What the force on a handle that cannot move makes of it: one in the middle, or, if it swings more than that explains, where it
    /// came to rest. Nothing in the known fluid, which does not flow.
    Swing carried{};
};
/// For tables: "arm", "let go at 3 Hz".
std::string held_how(const SwingRow& row);
struct PullRow {
    std::string fluid;
    double rate_hz;
    double error;
};
/// A scene's fluid, as it was found.
struct FluidRow {
    std::string fluid;
    double gain;                 ///< the scene's own
    double drag_ns_m, added_kg;  ///< at the handle, with that
    std::vector<double> gains;   ///< as they are at kRatesHz
};

struct Study {
    std::vector<FluidRow> fluids;
    std::vector<CircleRow> circles;
    std::vector<StirRow> stirs;
    std::vector<SwingRow> swings;
    std::vector<PullRow> pulls;
};

/// `gpu` may be null if there are no scenes. `progress`: seconds of fluid done and to do, weighed by what they cost.
Study study(gles::Gpu* gpu, const StudyOrder& order,
            const std::function<void(double done, double total, const std::string& what)>& progress);

}  // namespace eddy::haptic_study
