#pragma once
#include <string>

#include "firmware/quality/quality.h"

namespace eddy::accuracy::sweep {

/// How the force is measured; the two others are those of outputs.force_methods.
enum class ForceWay {
    Surface,  ///< pressure and friction summed over the surface
    Box,      ///< balance of momentum in a box around the body
    Impulse   ///< what the body gives to the fluid it touches
};

/// One position of every knob. The method brings its transport and its treatment of boundaries with it: `fast` has
/// semi-Lagrangian transport and cut cells, `precise` MacCormack and cut cells, `yang2009` semi-Lagrangian and voxels.
struct Setting {
    SolverPreset method = SolverPreset::Fast;
    int cells = 32;          ///< along the longest side
    int iterations = 2;      ///< of the pressure: multigrid cycles, or Jacobi sweeps with yang2009
    double dt_factor = 1.0;  ///< over the time step of the case
    ForceWay force = ForceWay::Surface;
    bool operator==(const Setting&) const = default;
};

/// Every method, in the order of tables and keys.
inline constexpr SolverPreset kMethods[] = {SolverPreset::Fast, SolverPreset::Precise,
                                            SolverPreset::Yang2009};

/// "surface", "box", "impulse".
std::string word_of(ForceWay way);
/// Throws std::invalid_argument if the word is none of them.
ForceWay force_way(const std::string& word);

/// "fast 32^3, 2 cycles", and what else differs from the usual.
std::string describe(const Setting& setting);

/// The scene, already on the setting's grid, with everything else as the setting says. The time step is as near to its
/// factor as a whole number of steps allows.
Scene applied(Scene scene, const Setting& setting);

}  // namespace eddy::accuracy::sweep
