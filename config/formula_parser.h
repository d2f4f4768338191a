#pragma once
#include <string_view>
#include <vector>

#include "config/formula.h"

namespace eddy {

/// The syntax tree of a formula: arguments before what they are arguments of, the whole formula last. Throws
/// FormulaError.
std::vector<FormulaTerm> parse_formula(std::string_view text);

}  // namespace eddy
