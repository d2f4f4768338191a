#include "config/formula_operations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "config/formula.h"

namespace eddy {
namespace {

double smooth_step(double low, double high, double x) {
    const double s = high == low ? (x < low ? 0.0 : 1.0) : std::clamp((x - low) / (high - low), 0.0, 1.0);
    return s * s * (3.0 - 2.0 * s);
}

constexpr FormulaOperation kOperations[] = {
    {"-", 1, [](const double* a) { return -a[0]; }, "(-$1)"},
    {"+", 2, [](const double* a) { return a[0] + a[1]; }, "($1 + $2)"},
    {"-", 2, [](const double* a) { return a[0] - a[1]; }, "($1 - $2)"},
    {"*", 2, [](const double* a) { return a[0] * a[1]; }, "($1 * $2)"},
    {"/", 2, [](const double* a) { return a[0] / a[1]; }, "($1 / $2)"},
    {"<", 2, [](const double* a) { return a[0] < a[1] ? 1.0 : 0.0; }, "float($1 < $2)"},
    {"<=", 2, [](const double* a) { return a[0] <= a[1] ? 1.0 : 0.0; }, "float($1 <= $2)"},
    {">", 2, [](const double* a) { return a[0] > a[1] ? 1.0 : 0.0; }, "float($1 > $2)"},
    {">=", 2, [](const double* a) { return a[0] >= a[1] ? 1.0 : 0.0; }, "float($1 >= $2)"},
    {"==", 2, [](const double* a) { return a[0] == a[1] ? 1.0 : 0.0; }, "float($1 == $2)"},
    {"!=", 2, [](const double* a) { return a[0] != a[1] ? 1.0 : 0.0; }, "float($1 != $2)"},
    {"if", 3, [](const double* a) { return a[0] != 0.0 ? a[1] : a[2]; }, "($1 != 0.0 ? $2 : $3)"},
    {"pow", 2, [](const double* a) { return std::pow(a[0], a[1]); }, "formula_pow($1, $2)"},
    {"sqrt", 1, [](const double* a) { return std::sqrt(a[0]); }, "sqrt($1)"},
    {"exp", 1, [](const double* a) { return std::exp(a[0]); }, "exp($1)"},
    {"log", 1, [](const double* a) { return std::log(a[0]); }, "log($1)"},
    {"sin", 1, [](const double* a) { return std::sin(a[0]); }, "sin($1)"},
    {"cos", 1, [](const double* a) { return std::cos(a[0]); }, "cos($1)"},
    {"tan", 1, [](const double* a) { return std::tan(a[0]); }, "tan($1)"},
    {"asin", 1, [](const double* a) { return std::asin(a[0]); }, "asin($1)"},
    {"acos", 1, [](const double* a) { return std::acos(a[0]); }, "acos($1)"},
    {"atan", 1, [](const double* a) { return std::atan(a[0]); }, "atan($1)"},
    {"atan2", 2, [](const double* a) { return std::atan2(a[0], a[1]); }, "formula_atan2($1, $2)"},
    {"sinh", 1, [](const double* a) { return std::sinh(a[0]); }, "sinh($1)"},
    {"cosh", 1, [](const double* a) { return std::cosh(a[0]); }, "cosh($1)"},
    // Some drivers divide two exponentials, both infinite from 45 on; from 10 on tanh is 1 in a float.
    {"tanh", 1, [](const double* a) { return std::tanh(a[0]); }, "tanh(clamp($1, -10.0, 10.0))"},
    {"erf", 1, [](const double* a) { return std::erf(a[0]); }, "formula_erf($1)"},
    {"abs", 1, [](const double* a) { return std::abs(a[0]); }, "abs($1)"},
    {"sign", 1, [](const double* a) { return a[0] > 0.0   ? 1.0
                                             : a[0] < 0.0 ? -1.0
                                                          : 0.0; }, "sign($1)"},
    {"floor", 1, [](const double* a) { return std::floor(a[0]); }, "floor($1)"},
    {"mod", 2, [](const double* a) { return a[0] - a[1] * std::floor(a[0] / a[1]); }, "mod($1, $2)"},
    {"min", 2, [](const double* a) { return std::min(a[0], a[1]); }, "min($1, $2)"},
    {"max", 2, [](const double* a) { return std::max(a[0], a[1]); }, "max($1, $2)"},
    {"step", 2, [](const double* a) { return a[1] < a[0] ? 0.0 : 1.0; }, "step($1, $2)"},
    {"smoothstep", 3, [](const double* a) { return smooth_step(a[0], a[1], a[2]); },
     "formula_smoothstep($1, $2, $3)"},
};

/// Functions that GLSL lacks, or leaves undefined where formulas are not.
struct Helper {
    std::string_view call;
    std::string_view text;
};
constexpr Helper kHelpers[] = {
    {"formula_pow(",
     "float formula_pow(float a, float b) {\n"
     "    if (a == 0.0) return b == 0.0 ? 1.0 : b > 0.0 ? 0.0 : 1.0 / a;\n"
     "    float p = pow(abs(a), b);\n"
     "    return a < 0.0 && mod(b, 2.0) == 1.0 ? -p : p;\n"
     "}\n"},
    {"formula_atan2(",
     "float formula_atan2(float a, float b) {\n"
     "    return a == 0.0 && b == 0.0 ? 0.0 : atan(a, b);\n"
     "}\n"},
    // Abramowitz & Stegun 1964, 7.1.26; wrong by 1.5e-7 at most.
    {"formula_erf(",
     "float formula_erf(float a) {\n"
     "    float k = 1.0 / (1.0 + 0.3275911 * abs(a));\n"
     "    float s = 1.061405429 * k - 1.453152027;\n"
     "    s = ((s * k + 1.421413741) * k - 0.284496736) * k + 0.254829592;\n"
     "    return sign(a) * (1.0 - s * k * exp(-a * a));\n"
     "}\n"},
    {"formula_smoothstep(",
     "float formula_smoothstep(float a, float b, float c) {\n"
     "    float s = a == b ? step(a, c) : clamp((c - a) / (b - a), 0.0, 1.0);\n"
     "    return s * s * (3.0 - 2.0 * s);\n"
     "}\n"},
};

bool is_word(std::string_view name) {
    return name.front() >= 'a' && name.front() <= 'z';
}

}  // namespace

std::span<const FormulaOperation> formula_operations() {
    return kOperations;
}

std::size_t operation_row(std::string_view name, std::size_t arguments) {
    const auto found =
        std::find_if(std::begin(kOperations), std::end(kOperations),
                     [&](const FormulaOperation& o) { return o.name == name && o.arguments == arguments; });
    return static_cast<std::size_t>(found - std::begin(kOperations));
}

std::optional<std::size_t> function_row(std::string_view name) {
    for (std::size_t row = 0; row < std::size(kOperations); ++row) {
        if (kOperations[row].name == name && is_word(name)) return row;
    }
    return std::nullopt;
}

std::vector<std::string_view> function_names() {
    std::vector<std::string_view> names;
    for (const FormulaOperation& operation : kOperations) {
        if (is_word(operation.name)) names.push_back(operation.name);
    }
    return names;
}

std::string formula_helpers(std::string_view glsl) {
    std::string out;
    for (const Helper& helper : kHelpers) {
        if (glsl.find(helper.call) != std::string_view::npos) out += helper.text;
    }
    std::string product = "a";
    for (int n = 2; n <= kHighestProduct; ++n) {
        product += " * a";
        const std::string call = fmt::format("formula_pow{}(", n);
        if (glsl.find(call) != std::string_view::npos)
            out += fmt::format("float {}float a) {{ return {}; }}\n", call, product);
    }
    return out;
}

std::string formula_guide() {
    return fmt::format(
        "A formula is a number, or text with an expression in x, y, z [m] and t [s]: numbers, pi, e, + - * / "
        "^ and brackets, comparisons (1 if true, 0 if not), the choice a ? b : c or if(a, b, c), and the "
        "functions {}. ^ binds tightest, then the minus sign: -x^2 is -(x^2). mod(a, b) has the sign of b; "
        "step(a, x) is 1 from x = a on; smoothstep(a, b, x) rises from 0 at a to 1 at b; atan2(b, a) is the "
        "angle of the point (a, b); log is to the base e. t begins with the scene; GPUs have it as a number "
        "of "
        "32 bits, which a day later goes in steps of 8 ms.",
        fmt::join(function_names(), ", "));
}

}  // namespace eddy
