#pragma once
#include <string>

#include "firmware/effects/measurement.h"

namespace eddy::effects {

// What a measurement looks like on a terminal and in files.

/// Each variant: its times, and what its plan says of passes, fetches and bytes.
std::string table_of_variants(const EffectCosts& costs);
/// Each effect, the costliest first: what it adds to the whole scene, and alone to the bodies.
std::string table_of_effects(const EffectCosts& costs);
/// How much less the bodies alone cost than the whole scene.
std::string summary_of(const EffectCosts& costs);

/// The rows of the study, by what they add to the time of the whole scene.
std::vector<const EffectStudy::Row*> costliest_first(const EffectCosts& costs);

/// Two lines for each effect, `added_to` the whole scene or the bare one, and one for all but the bodies; of a step.
std::string csv_of(const EffectCosts& costs);
/// Everything, with what it ran on.
std::string json_of(const EffectCosts& costs, const gles::Capabilities& driver);

}  // namespace eddy::effects
