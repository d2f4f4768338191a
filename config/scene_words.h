#pragma once
#include "config/value.h"

// The enumerations of a scene file: each with its words and what they stand for.

namespace eddy {

enum class WallKind { Slip };
enum class BodyShape { Sphere };
enum class BodyMotion { Fixed, Prescribed, Held };
enum class SolverPreset { Fast, Precise, Yang2009 };
enum class AdvectionScheme { SemiLagrangian, MacCormack };
enum class OutputField { Velocity, Pressure, Smoke };

inline constexpr Word<WallKind> kWallKinds[] = {
    {WallKind::Slip, "slip", "no flow through, no friction along"},
};
inline constexpr Word<BodyShape> kBodyShapes[] = {
    {BodyShape::Sphere, "sphere", "of radius_m"},
};
inline constexpr Word<BodyMotion> kBodyMotions[] = {
    {BodyMotion::Fixed, "fixed", "stays at centre_m"},
    {BodyMotion::Prescribed, "prescribed", "moves as the keys below say"},
    {BodyMotion::Held, "held", "is in the visitor's hand (at most one)"},
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
inline constexpr Word<OutputField> kOutputFields[] = {
    {OutputField::Velocity, "velocity", "[m/s]"},
    {OutputField::Pressure, "pressure", "[Pa]"},
    {OutputField::Smoke, "smoke", "1 is what a source makes in 1 s at smoke_per_s = 1"},
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
constexpr std::span<const Word<OutputField>> words_of(OutputField) {
    return kOutputFields;
}

}  // namespace eddy
