#pragma once
#include "config/scene.h"
#include "firmware/quality/quality_control.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

// What the options of a run come to, with the exhibit's settings where they say nothing.

const std::string& scene_name(const RunOptions& options, const Exhibit& exhibit);

/// What the quality of the fluid hangs on. A run on the stepped clock is the same on every machine: it keeps the scene's own.
QualityControl::Setup quality_setup(const RunOptions& options, const Exhibit& exhibit, const Scene& scene);

/// Throws InputError, with the option's name, for what no run of this scene can do.
void require_possible(const RunOptions& options, const Exhibit& exhibit, const Scene& scene);

}  // namespace eddy
