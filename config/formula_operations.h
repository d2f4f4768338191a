#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

// What formulas are made of.

namespace eddy {

/// One row an operation: what it is on the CPU and on the GPU. A name that is a word is a function.
struct FormulaOperation {
    std::string_view name;
    std::size_t arguments;
    double (*value)(const double* a);
    std::string_view glsl;  // $1, $2, $3 are the arguments, each written once, or nested texts would explode
};

std::span<const FormulaOperation> formula_operations();

/// The row of the operation with this name and number of arguments, which there must be.
std::size_t operation_row(std::string_view name, std::size_t arguments);

/// The row of a function, if there is one with this name; functions have names that are words.
std::optional<std::size_t> function_row(std::string_view name);
std::vector<std::string_view> function_names();

inline constexpr std::string_view kFormulaVariables[] = {"x", "y", "z", "t"};

/// Whole powers up to here are products in GLSL: exact, and defined for negative bases.
inline constexpr int kHighestProduct = 16;

}  // namespace eddy
