#include "config/formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "config/formula_operations.h"
#include "config/formula_parser.h"

namespace eddy {
namespace {

/// A float literal: always with a decimal point, never infinite.
std::string literal(double number) {
    constexpr double largest = std::numeric_limits<float>::max();
    std::string text = fmt::format("{}", static_cast<float>(std::clamp(number, -largest, largest)));
    if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
    return number < 0.0 ? fmt::format("({})", text) : text;
}

}  // namespace

Formula::Formula(double number) : terms_{{.kind = FormulaTerm::Kind::Number, .number = number}} {}

Formula Formula::parse(std::string_view text) {
    Formula formula;
    formula.terms_ = parse_formula(text);
    formula.source_ = std::string(text);
    return formula;
}

double Formula::evaluate(double x_m, double y_m, double z_m, double t_s) const {
    return value_of(terms_.back(), {x_m, y_m, z_m, t_s});
}

double Formula::value_of(const FormulaTerm& term, const std::array<double, 4>& variables) const {
    if (term.kind == FormulaTerm::Kind::Number) return term.number;
    if (term.kind == FormulaTerm::Kind::Variable) return variables[term.which];
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < formula_operations()[term.which].arguments; ++i)
        values[i] = value_of(terms_[term.arguments[i]], variables);
    return formula_operations()[term.which].value(values.data());
}

std::string Formula::glsl() const {
    return glsl_of(terms_.back());
}

std::string Formula::glsl_of(const FormulaTerm& term) const {
    if (term.kind == FormulaTerm::Kind::Number) return literal(term.number);
    if (term.kind == FormulaTerm::Kind::Variable) return std::string(kFormulaVariables[term.which]);
    const FormulaOperation& operation = formula_operations()[term.which];
    if (operation.name == "pow") return glsl_of_power(terms_[term.arguments[0]], terms_[term.arguments[1]]);
    std::string out;
    for (std::size_t i = 0; i < operation.glsl.size(); ++i) {
        if (operation.glsl[i] == '$')
            out += glsl_of(terms_[term.arguments[static_cast<std::size_t>(operation.glsl[++i] - '1')]]);
        else
            out += operation.glsl[i];
    }
    return out;
}

std::string Formula::glsl_of_power(const FormulaTerm& base, const FormulaTerm& exponent) const {
    const double n = is_constant(exponent) ? value_of(exponent, {}) : 0.5;
    if (n != std::floor(n) || std::abs(n) > kHighestProduct)
        return fmt::format("formula_pow({}, {})", glsl_of(base), glsl_of(exponent));
    if (n == 0.0) return "1.0";
    const int factors = static_cast<int>(std::abs(n));
    const std::string product =
        factors == 1 ? glsl_of(base) : fmt::format("formula_pow{}({})", factors, glsl_of(base));
    return n > 0.0 ? product : fmt::format("(1.0 / {})", product);
}

bool Formula::is_constant(const FormulaTerm& term) const {
    if (term.kind != FormulaTerm::Kind::Operation) return term.kind == FormulaTerm::Kind::Number;
    const auto arguments = std::span(term.arguments).first(formula_operations()[term.which].arguments);
    return std::all_of(arguments.begin(), arguments.end(),
                       [&](std::size_t argument) { return is_constant(terms_[argument]); });
}

std::optional<double> Formula::constant() const {
    if (!is_constant(terms_.back())) return std::nullopt;
    return value_of(terms_.back(), {});
}

bool Formula::uses(char variable) const {
    return std::any_of(terms_.begin(), terms_.end(), [&](const FormulaTerm& term) {
        return term.kind == FormulaTerm::Kind::Variable && kFormulaVariables[term.which].front() == variable;
    });
}

glm::dvec3 FormulaVector::evaluate(const glm::dvec3& p, double t_s) const {
    return {x.evaluate(p.x, p.y, p.z, t_s), y.evaluate(p.x, p.y, p.z, t_s), z.evaluate(p.x, p.y, p.z, t_s)};
}

std::string FormulaVector::glsl() const {
    return fmt::format("vec3({}, {}, {})", x.glsl(), y.glsl(), z.glsl());
}

std::optional<glm::dvec3> FormulaVector::constant() const {
    const auto vx = x.constant(), vy = y.constant(), vz = z.constant();
    if (!vx || !vy || !vz) return std::nullopt;
    return glm::dvec3(*vx, *vy, *vz);
}

bool FormulaVector::uses(char variable) const {
    return x.uses(variable) || y.uses(variable) || z.uses(variable);
}

FormulaVector::operator glm::dvec3() const {
    if (const std::optional<glm::dvec3> numbers = constant()) return *numbers;
    throw std::logic_error("a formula was taken for three numbers");
}

}  // namespace eddy
