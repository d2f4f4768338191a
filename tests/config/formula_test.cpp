#include "config/formula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace eddy {
namespace {

using testing::HasSubstr;
using testing::Not;

double value(const std::string& text, double x = 0.3, double y = -0.7, double z = 1.9, double t = 0.25) {
    return Formula::parse(text).evaluate(x, y, z, t);
}

std::string glsl(const std::string& text) {
    return Formula::parse(text).glsl();
}

// "column: message", or nothing.
std::string fault(const std::string& text) {
    try {
        Formula::parse(text);
        return "";
    } catch (const FormulaError& error) {
        return std::to_string(error.column) + ": " + error.what();
    }
}

TEST(Formula, DivisionBindsTighterThanSum) {
    EXPECT_EQ(value("1 + 6 / 3"), 3.0);
    EXPECT_EQ(value("(1 + 6) / 7"), 1.0);
    EXPECT_EQ(value("8 - 3 - 2"), 3.0);
    EXPECT_EQ(value("8 / 4 / 2"), 1.0);
}

TEST(Formula, PowerBindsTighterThanMinusAndFromTheRight) {
    EXPECT_EQ(value("-3^2"), -9.0);
    EXPECT_EQ(value("2^3^2"), 512.0);
    EXPECT_EQ(value("2^-2"), 0.25);
    EXPECT_EQ(value("2 * -3"), -6.0);
    EXPECT_EQ(value("2^-1 * 6"), 3.0);
    EXPECT_EQ(value("--3 - -+2"), 5.0);
}

TEST(Formula, ComparisonIsOneOrZeroAndLooserThanSum) {
    EXPECT_EQ(value("1 < 2"), 1.0);
    EXPECT_EQ(value("2 <= 1 + 0"), 0.0);
    EXPECT_EQ(value("(2 > 1) + (2 >= 2) + (1 == 1) + (1 != 1)"), 3.0);
}

TEST(Formula, ChoiceIsLoosestAndFromTheRight) {
    EXPECT_EQ(value("1 < 2 ? 3 + 4 : 5"), 7.0);
    EXPECT_EQ(value("x > 1 ? 1 : x > 0 ? 2 : 3"), 2.0);
    EXPECT_EQ(value("if(x < 0, 1, 2)"), 2.0);
    EXPECT_EQ(value("x < 0 ? sqrt(x) : 4"), 4.0);
}

TEST(Formula, NumbersAloneAreFormulas) {
    for (const auto& [text, number] : {std::pair("0.5", 0.5),
                                       {".5", 0.5},
                                       {"5.", 5.0},
                                       {" 1e-3\n", 1e-3},
                                       {"2E2", 200.0},
                                       {"pi", std::acos(-1.0)},
                                       {"e", std::exp(1.0)}})
        EXPECT_DOUBLE_EQ(value(text), number) << text;
    EXPECT_EQ(Formula(2.5).evaluate(1, 2, 3, 4), 2.5);
    EXPECT_EQ(Formula(), Formula(0.0));
}

TEST(Formula, FunctionsAreThoseOfTheStandardLibrary) {
    using F = std::function<double(double, double)>;
    const std::vector<std::pair<std::string, F>> pairs = {
        {"sin(x)", [](double x, double) { return std::sin(x); }},
        {"cos(x)", [](double x, double) { return std::cos(x); }},
        {"tan(x)", [](double x, double) { return std::tan(x); }},
        {"asin(x)", [](double x, double) { return std::asin(x); }},
        {"acos(x)", [](double x, double) { return std::acos(x); }},
        {"atan(x)", [](double x, double) { return std::atan(x); }},
        {"atan2(x, y)", [](double x, double y) { return std::atan2(x, y); }},
        {"sinh(x)", [](double x, double) { return std::sinh(x); }},
        {"cosh(x)", [](double x, double) { return std::cosh(x); }},
        {"tanh(x)", [](double x, double) { return std::tanh(x); }},
        {"exp(x)", [](double x, double) { return std::exp(x); }},
        {"log(x^2)", [](double x, double) { return std::log(x * x); }},
        {"sqrt(abs(x))", [](double x, double) { return std::sqrt(std::abs(x)); }},
        {"erf(x)", [](double x, double) { return std::erf(x); }},
        {"min(x, y)", [](double x, double y) { return std::min(x, y); }},
        {"max(x, y)", [](double x, double y) { return std::max(x, y); }},
        {"floor(x * 7)", [](double x, double) { return std::floor(x * 7); }},
        {"sign(x)", [](double x, double) { return x > 0 ? 1.0 : -1.0; }},
        {"pow(abs(x), y)", [](double x, double y) { return std::pow(std::abs(x), y); }},
        {"step(y, x)", [](double x, double y) { return x < y ? 0.0 : 1.0; }},
        {"x^3 - y^2", [](double x, double y) { return x * x * x - y * y; }}};
    for (const auto& [text, reference] : pairs) {
        const Formula formula = Formula::parse(text);
        for (const auto& [x, y] : {std::pair(0.3, -0.7), {-0.9, 0.4}, {0.5, 2.5}})
            EXPECT_NEAR(formula.evaluate(x, y, 0, 0), reference(x, y), 1e-14) << text;
    }
}

TEST(Formula, ModHasTheSignOfTheDivisorAndSmoothstepItsEdges) {
    EXPECT_EQ(value("mod(-1, 3)"), 2.0);
    EXPECT_EQ(value("mod(7, -4)"), -1.0);
    EXPECT_EQ(value("smoothstep(1, 3, 0)"), 0.0);
    EXPECT_EQ(value("smoothstep(1, 3, 2)"), 0.5);
    EXPECT_EQ(value("smoothstep(1, 3, 9)"), 1.0);
    EXPECT_EQ(value("smoothstep(1, 1, 1)"), 1.0);
    EXPECT_EQ(value("sign(0)"), 0.0);
}

TEST(Formula, KnowsWhatItDependsOn) {
    const Formula formula = Formula::parse("sin(x) * t");
    EXPECT_TRUE(formula.uses('x') && formula.uses('t'));
    EXPECT_FALSE(formula.uses('y') || formula.uses('z'));
    EXPECT_FALSE(formula.constant());
    EXPECT_EQ(Formula::parse("2 * cos(0)").constant(), 2.0);
    EXPECT_EQ(Formula(-3).constant(), -3.0);
}

TEST(Formula, VectorsAreThreeFormulas) {
    const FormulaVector v = {Formula::parse("x + t"), 2.0, Formula::parse("-z")};
    EXPECT_EQ(v.evaluate({1, 2, 3}, 10), glm::dvec3(11, 2, -3));
    EXPECT_EQ(v.glsl(), "vec3((x + t), 2.0, (-z))");
    EXPECT_TRUE(v.uses('z'));
    EXPECT_FALSE(v.uses('y'));
    EXPECT_FALSE(v.constant());
    EXPECT_THROW(static_cast<void>(glm::dvec3(v)), std::logic_error);
    const FormulaVector numbers = {1.0, Formula::parse("1 + 1"), 3.0};
    EXPECT_EQ(numbers.constant(), glm::dvec3(1, 2, 3));
}

TEST(FormulaError, NamesColumnAndNearestName) {
    EXPECT_EQ(fault("1 + sinn(x)"), "5: unknown function \"sinn\"; nearest: sin");
    EXPECT_EQ(fault("2 * tt"), "5: unknown name \"tt\"; nearest: t");
    EXPECT_EQ(fault("smothstep(0, 1, x)"), "1: unknown function \"smothstep\"; nearest: smoothstep");
    EXPECT_EQ(fault("y(3)"), "1: unknown function \"y\"; nearest: if");
    EXPECT_EQ(fault("sin"), "1: sin is a function: write sin(...)");
    EXPECT_EQ(fault("1 + atan2(x)"), "5: atan2 takes 2 arguments, not 1");
    EXPECT_EQ(fault("sin(x, y, z, t)"), "1: sin takes 1 argument, not 4");
    EXPECT_EQ(fault("2x"), "2: an operator is missing here; a product is written with *");
    EXPECT_EQ(fault("(x + 1"), "7: expected \")\" to close the bracket, found the end");
    EXPECT_EQ(fault("x + 1)"), "6: this ) closes nothing");
    EXPECT_EQ(fault("x +"), "4: expected a number, a name or a bracket, found the end");
    EXPECT_EQ(fault("x > 0 ? 1"), "10: expected \":\" of the choice a ? b : c, found the end");
    EXPECT_EQ(fault("0 < x < 1"), "7: comparisons cannot be chained; multiply them: (0 < x) * (x < 1)");
    EXPECT_EQ(fault("x = 1"), "3: \"=\" has no place here");
    EXPECT_EQ(fault("x + \xc3\xa9"), "5: expected a number, a name or a bracket, found this character");
    EXPECT_EQ(fault("1e999"), "1: this number is too large or too small");
    EXPECT_EQ(fault("  "), "1: is empty: write a number, or an expression in x, y, z and t");
    EXPECT_EQ(fault("nan"), "1: unknown name \"nan\"; nearest: tan");
}

// On Mesa x / 0.0 is some 1e31 in a shader: no number that a guard could tell from a strong wind.
TEST(FormulaError, DivisionByZeroIsNamed) {
    EXPECT_EQ(fault("1 / 0"), "3: this divides by 0: it has no value anywhere");
    EXPECT_EQ(fault("y + x / (1 - 1)"), "7: this divides by 0: it has no value anywhere");
    EXPECT_EQ(fault("x / 1e-300"), "3: this divides by 0: it has no value anywhere");
    EXPECT_EQ(fault("x / sin(0 * 2)"), "3: this divides by 0: it has no value anywhere");
    EXPECT_EQ(fault("x / (y - y)"), "") << "it is up to the guard in the shader";
    EXPECT_EQ(fault("x / 1e-30"), "");
}

TEST(FormulaError, LengthAndDepthAreLimited) {
    EXPECT_THAT(fault(std::string(5000, '1')), HasSubstr("is too long"));
    for (const std::string unit : {"(", "-", "sin(", "2^", "1?", "1?1:", "1+(", "1<("}) {
        std::string text;
        while (text.size() < 3900) text += unit;
        EXPECT_THAT(fault(text), Not("")) << unit;
    }
    std::string sum = "x";
    for (int i = 0; i < 1000; ++i) sum += "+x";
    EXPECT_THAT(fault(sum), HasSubstr("bracket parts of a long sum"));
    EXPECT_EQ(fault(sum.substr(0, 2 * 150 + 1)), "");
}

TEST(FormulaGlsl, EveryLiteralHasADecimalPoint) {
    EXPECT_EQ(glsl("1"), "1.0");
    EXPECT_EQ(glsl("1e-7 * 2e20"), "(1.0e-07 * 2.0e+20)");
    EXPECT_EQ(glsl("0.1"), "0.1");
    EXPECT_EQ(glsl("pi"), "3.1415927");
    EXPECT_EQ(Formula(-2).glsl(), "(-2.0)");
    EXPECT_EQ(glsl("1e300"), "3.4028235e+38");
    EXPECT_EQ(glsl("1e-300"), "0.0");
}

TEST(FormulaGlsl, KeepsTheTreeWithBrackets) {
    EXPECT_EQ(glsl("1 - (2 - x)"), "(1.0 - (2.0 - x))");
    EXPECT_EQ(glsl("--y"), "(-(-y))");
    EXPECT_EQ(glsl("x < y ? z : t"), "(float(x < y) != 0.0 ? z : t)");
    EXPECT_EQ(glsl("max(sin(x), mod(y, 2))"), "max(sin(x), mod(y, 2.0))");
}

TEST(FormulaGlsl, WholePowersAreProducts) {
    EXPECT_EQ(glsl("(x + 1)^2"), "formula_pow2((x + 1.0))");
    EXPECT_EQ(glsl("x^-3"), "(1.0 / formula_pow3(x))");
    EXPECT_EQ(glsl("x^(4 / 2)"), "formula_pow2(x)");
    EXPECT_EQ(glsl("x^1 + x^0"), "(x + 1.0)");
    EXPECT_EQ(glsl("x^0.5"), "formula_pow(x, 0.5)");
    EXPECT_EQ(glsl("x^99"), "formula_pow(x, 99.0)");
    EXPECT_EQ(glsl("pow(x, y)"), "formula_pow(x, y)");
    EXPECT_EQ(formula_helpers(glsl("x^3")), "float formula_pow3(float a) { return a * a * a; }\n");
}

TEST(FormulaGlsl, BringsTheHelpersItCallsAndNoOthers) {
    EXPECT_EQ(formula_helpers(glsl("sin(x) + tanh(y)")), "");
    const std::string helpers = formula_helpers(glsl("erf(x) + erf(y)") + glsl("x^2"));
    EXPECT_THAT(helpers, HasSubstr("float formula_erf(float a) {"));
    EXPECT_EQ(helpers.find("formula_erf(float"), helpers.rfind("formula_erf(float"));
    EXPECT_THAT(helpers, HasSubstr("float formula_pow2(float a)"));
    EXPECT_THAT(helpers, Not(HasSubstr("formula_atan2")));
    EXPECT_THAT(helpers, Not(HasSubstr("formula_pow(")));
}

TEST(FormulaGlsl, NestedPowersDoNotGrow) {
    std::string text = "x";
    for (int i = 0; i < 60; ++i) text = "tanh(" + text + ")^9";
    EXPECT_LT(glsl(text).size(), 60 * text.size());
}

// Whatever the bytes: either a formula, whose two uses then hold, or an error inside the text.
TEST(FormulaFuzz, TwentyThousandTextsAreFormulasOrErrors) {
    const std::vector<std::string> scraps = {
        "x",      "y",  "z",    "t",    "pi",     "e",   "1",    "2.5",         "1e9",  ".",   "+",   "-",
        "*",      "/",  "^",    "(",    ")",      "(",   ")",    "?",           ":",    "<",   "<=",  "==",
        "!=",     ",",  " ",    "sin(", "atan2(", "if(", "erf(", "smoothstep(", "mod(", "x^2", "^-3", "(x+1)",
        "1e-320", "\0", "\xff", "\n",   "q",      "nan", "inf",  "0x",          "_",    "\""};
    std::mt19937 random(7);
    const auto below = [&](std::size_t n) {
        return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
    };
    int formulas = 0;
    for (int i = 0; i < 20000; ++i) {
        std::string text;
        if (i % 2 == 0) {
            text = "sin(pi * x)^2 * exp(-t / 0.1) + if(y < 0.5, z, mod(x, 2)) - 1e-3";
            for (std::size_t slips = 1 + below(2); slips > 0; --slips)
                text.replace(below(text.size()), 1, scraps[below(scraps.size())]);
        } else if (i % 4 == 1) {
            for (std::size_t n = below(60); n > 0; --n) text += static_cast<char>(below(256));
        } else {
            for (std::size_t n = 1 + below(9); n > 0; --n) text += scraps[below(scraps.size())];
        }
        try {
            const Formula formula = Formula::parse(text);
            ++formulas;
            formula.evaluate(0.1, 0.2, 0.3, 0.4);
            const std::string code = formula.glsl();
            ASSERT_EQ(std::count(code.begin(), code.end(), '('), std::count(code.begin(), code.end(), ')'));
            ASSERT_THAT(code, Not(HasSubstr("inf")));
            ASSERT_THAT(code, Not(HasSubstr("nan")));
            ASSERT_THAT(code, Not(HasSubstr("$")));
            formula_helpers(code);
        } catch (const FormulaError& error) {
            ASSERT_GE(error.column, 1u) << text;
            ASSERT_LE(error.column, text.size() + 1) << text;
            ASSERT_STRNE(error.what(), "");
        }
    }
    EXPECT_GT(formulas, 500);
    EXPECT_LT(formulas, 19500);
}

}  // namespace
}  // namespace eddy
