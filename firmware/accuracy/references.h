#pragma once

// What cases are judged by where no formula gives it: numbers of a ball of radius a in the middle of a cube of side L, from the
// method of fundamental solutions (point sources, or Stokeslets, inside the ball and outside the walls, of strengths that
// fit the boundary values best in the least-squares sense).

namespace eddy::accuracy::references {

/// Added mass over the mass of the fluid displaced, a perfect fluid; what is left of the boundary values is below 1e-4.
inline constexpr double kAddedMassInBox = 0.50730;       // a / L = 0.1: B2-box
inline constexpr double kAddedMassInTightBox = 0.56047;  // a / L = 0.2: B10

/// Creeping flow between no-slip walls, a / L = 0.2: drag over 6 pi mu a U, torque over 8 pi mu a^3 Omega. Two resolutions
/// agree to 5 digits.
inline constexpr double kDragInBox = 3.12346;    // B3
inline constexpr double kTorqueInBox = 1.04749;  // B4

/// Added mass over the mass displaced, of a ball in the middle of a round shell, l = a / b = 0.4: (1 + 2 l^3) / (2 (1 - l^3))
/// (Lamb, Hydrodynamics). B2-shell.
inline constexpr double kAddedMassInShell = 0.60256;

}  // namespace eddy::accuracy::references
