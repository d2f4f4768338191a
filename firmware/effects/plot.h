#pragma once
#include <filesystem>

#include "firmware/effects/measurement.h"

namespace eddy::effects {

/// Draws what each effect adds, in ms and in MB of textures, as bars into a PNG, by gnuplot; leaves the gnuplot script beside
/// it. False if there is no picture (draw_with_gnuplot has said why).
bool plot(const EffectCosts& costs, const gles::Capabilities& driver, const std::filesystem::path& picture);

}  // namespace eddy::effects
