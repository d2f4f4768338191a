#pragma once
#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace eddy {

/// What is wrong with the text of a formula; column is that of the first character that does not fit, from 1.
struct FormulaError : std::runtime_error {
    FormulaError(std::size_t column_of_fault, const std::string& message)
        : std::runtime_error(message), column(column_of_fault) {}
    std::size_t column;
};

/// A node of a formula's syntax tree.
struct FormulaTerm {
    enum class Kind { Number, Variable, Operation };
    Kind kind = Kind::Number;
    double number = 0.0;
    std::size_t which = 0;  // variable: 0 x ... 3 t; operation: its row (formula_operations.h)
    std::array<std::size_t, 3> arguments{};  // terms
    bool operator==(const FormulaTerm&) const = default;
};

/// A quantity that may vary in space and time: a number, or an expression in x, y, z [m] and t [s]. One
/// syntax tree serves the CPU (evaluate) and the GPU (glsl). What can be written is in formula_guide().
class Formula {
  public:
    /// A number is a formula too.
    Formula(double number = 0.0);

    /// Throws FormulaError.
    static Formula parse(std::string_view text);

    /// Where a function has no value, as sqrt(-1), the result is not finite.
    double evaluate(double x_m, double y_m, double z_m, double t_s) const;

    /// A GLSL ES 3.00 expression over floats named x, y, z and t; it may call formula_helpers(). Undefined
    /// where evaluate() is not finite.
    std::string glsl() const;

    /// Its value, if neither x nor y nor z nor t occurs in it.
    std::optional<double> constant() const;

    /// Whether the variable 'x', 'y', 'z' or 't' occurs in it.
    bool uses(char variable) const;

    /// The text it was parsed from; nothing for a plain number.
    const std::optional<std::string>& source() const { return source_; }

    bool operator==(const Formula&) const = default;

  private:
    double value_of(const FormulaTerm& term, const std::array<double, 4>& variables) const;
    std::string glsl_of(const FormulaTerm& term) const;
    std::string glsl_of_power(const FormulaTerm& base, const FormulaTerm& exponent) const;
    bool is_constant(const FormulaTerm& term) const;

    std::optional<std::string> source_;
    std::vector<FormulaTerm> terms_;  // as parse_formula() returns them
};

/// A vector whose components are formulas.
struct FormulaVector {
    Formula x, y, z;

    glm::dvec3 evaluate(const glm::dvec3& position_m, double t_s) const;
    /// A vec3, as Formula::glsl().
    std::string glsl() const;
    std::optional<glm::dvec3> constant() const;
    bool uses(char variable) const;
    /// Its value where it is constant(); throws std::logic_error where it is not.
    operator glm::dvec3() const;
    bool operator==(const FormulaVector&) const = default;
};

/// The GLSL functions that `glsl`, a text made of formulas, calls: each once, nothing if it calls none.
std::string formula_helpers(std::string_view glsl);

/// What a formula may hold, in one paragraph of markdown.
std::string formula_guide();

}  // namespace eddy
