#pragma once
#include "config/value.h"

// The enumerations of a scene file: each with its words and what they stand for.

namespace eddy {

enum class WallKind { Slip, NoSlip, Inflow, Open };
enum class BodyShape { Sphere, Box, Capsule, Cylinder, Torus, Ellipsoid, Disk, Paddle, Tetrahedron, Mesh };
enum class BodyMotion { Fixed, Prescribed, Held, Free };
enum class SolverPreset { Fast, Precise, Yang2009 };
enum class AdvectionScheme { SemiLagrangian, MacCormack };
enum class ForceSum { Gpu, Cpu };
enum class ProbeQuantity { Velocity, Pressure, Smoke, Temperature };
enum class OutputField { Velocity, Pressure, Smoke, Temperature, Vorticity };

inline constexpr Word<WallKind> kWallKinds[] = {
    {WallKind::Slip, "slip", "no flow through, no friction along"},
    {WallKind::NoSlip, "no_slip", "the fluid sticks to it; velocity_m_s moves it along itself"},
    {WallKind::Inflow, "inflow", "fluid enters with velocity_m_s"},
    {WallKind::Open, "open", "fluid leaves freely, or comes in from rest; the pressure there is 0"},
};
inline constexpr Word<BodyShape> kBodyShapes[] = {
    {BodyShape::Sphere, "sphere", ""},
    {BodyShape::Box, "box", ""},
    {BodyShape::Capsule, "capsule", "a cylinder with round ends, along y"},
    {BodyShape::Cylinder, "cylinder", "along y"},
    {BodyShape::Torus, "torus", "a ring around y"},
    {BodyShape::Ellipsoid, "ellipsoid", ""},
    {BodyShape::Disk, "disk", "flat, square to y"},
    {BodyShape::Paddle, "paddle", "a flat blade under a round handle, both along y; centre_m is the blade's"},
    {BodyShape::Tetrahedron, "tetrahedron", "regular"},
    {BodyShape::Mesh, "mesh", "a closed surface of triangles"},
};
inline constexpr Word<BodyMotion> kBodyMotions[] = {
    {BodyMotion::Fixed, "fixed", "stays at centre_m"},
    {BodyMotion::Prescribed, "prescribed", "moves as the keys below say"},
    {BodyMotion::Held, "held", "is in the visitor's hand (at most one)"},
    {BodyMotion::Free, "free", "moves as the fluid and gravity push it"},
};
inline constexpr Word<SolverPreset> kSolverPresets[] = {
    {SolverPreset::Fast, "fast", "cut cells, multigrid with 2 cycles, semi-Lagrangian transport"},
    {SolverPreset::Precise, "precise", "cut cells, multigrid with 3 cycles, MacCormack transport"},
    {SolverPreset::Yang2009, "yang2009", "the method of Yang et al. 2009: four cell types, Jacobi"},
};
inline constexpr Word<AdvectionScheme> kAdvectionSchemes[] = {
    {AdvectionScheme::SemiLagrangian, "semi_lagrangian", "first order, smooths"},
    {AdvectionScheme::MacCormack, "maccormack", "second order, limited"},
};
inline constexpr Word<ForceSum> kForceSums[] = {
    {ForceSum::Gpu, "gpu", "in a tree of passes, reading one texel back"},
    {ForceSum::Cpu, "cpu", "reading the force of every cell back"},
};
inline constexpr Word<ProbeQuantity> kProbeQuantities[] = {
    {ProbeQuantity::Velocity, "velocity", "[m/s]"},
    {ProbeQuantity::Pressure, "pressure", "[Pa]"},
    {ProbeQuantity::Smoke, "smoke", "as in the fields"},
    {ProbeQuantity::Temperature, "temperature", "[K] above the reference"},
};
inline constexpr Word<OutputField> kOutputFields[] = {
    {OutputField::Velocity, "velocity", "[m/s]"},
    {OutputField::Pressure, "pressure", "[Pa]"},
    {OutputField::Smoke, "smoke", "1 is what a source makes in 1 s at smoke_per_s = 1"},
    {OutputField::Temperature, "temperature", "[K] above the reference"},
    {OutputField::Vorticity, "vorticity", "[1/s]"},
};
constexpr std::span<const Word<WallKind>> words_of(WallKind) {
    return kWallKinds;
}
constexpr std::span<const Word<BodyShape>> words_of(BodyShape) {
    return kBodyShapes;
}
constexpr std::span<const Word<BodyMotion>> words_of(BodyMotion) {
    return kBodyMotions;
}
constexpr std::span<const Word<SolverPreset>> words_of(SolverPreset) {
    return kSolverPresets;
}
constexpr std::span<const Word<AdvectionScheme>> words_of(AdvectionScheme) {
    return kAdvectionSchemes;
}
constexpr std::span<const Word<ForceSum>> words_of(ForceSum) {
    return kForceSums;
}
constexpr std::span<const Word<ProbeQuantity>> words_of(ProbeQuantity) {
    return kProbeQuantities;
}
constexpr std::span<const Word<OutputField>> words_of(OutputField) {
    return kOutputFields;
}

}  // namespace eddy
