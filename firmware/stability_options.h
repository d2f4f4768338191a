#pragma once
#include <CLI/CLI.hpp>

#include "firmware/verbs/verbs.h"

namespace eddy {

/// The command line of eddy stability.
void add_stability(CLI::App& app, StabilityOptions& stability);

/// What goes with what: else an option would be silently without effect. Throws InputError. `verb`: eddy stability, parsed.
void check_stability(const CLI::App& verb);

}  // namespace eddy
