#pragma once
#include "config/reader.h"

namespace eddy {

/// What file the diagnostics of an override name.
inline constexpr std::string_view kOverrideFile = "--set";

/// Writes one command-line override "key.path=value" into a document, value as in TOML: solver.dt_s=0.01,
/// body.0.radius_m=0.02 or body.NAME.radius_m=0.02, tank.cells=[32, 32, 32]. Tables that are missing are
/// made; an unknown key is found out when the document is read. `number` is its place among the overrides,
/// from 1: the line of the diagnostics.
void apply_override(Node& document, std::string_view text, int number, std::vector<Diagnostic>& diagnostics);

}  // namespace eddy
