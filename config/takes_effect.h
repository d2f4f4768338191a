#pragma once
#include "config/value.h"

namespace eddy {

/// When a new value of an exhibit's key counts.
enum class TakesEffect { Live, Scene, Process, Boot };

inline constexpr Word<TakesEffect> kTakesEffect[] = {
    {TakesEffect::Live, "live", "at once"},
    {TakesEffect::Scene, "scene", "with the scene built anew; the old one runs on until then"},
    {TakesEffect::Process, "process", "when the program starts again"},
    {TakesEffect::Boot, "boot", "when the machine starts again"},
};
constexpr std::span<const Word<TakesEffect>> words_of(TakesEffect) {
    return kTakesEffect;
}

}  // namespace eddy
