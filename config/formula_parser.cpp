#include "config/formula_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <numbers>

#include "config/diagnostic.h"
#include "config/formula_operations.h"
#include "config/nearest.h"

namespace eddy {
namespace {

constexpr std::size_t kLongest = 4000;  // characters
constexpr int kDeepest = 200;           // operations inside operations; GLSL compilers recurse too

/// Operators between two operands; one with a higher level binds tighter. Longer signs come first.
struct Sign {
    std::string_view sign;
    int level;
    std::string_view operation;
};
constexpr int kChoice = 1, kComparison = 2, kSum = 3, kProduct = 4, kMinus = 5, kPower = 6;
constexpr Sign kSigns[] = {
    {"<=", kComparison, "<="}, {">=", kComparison, ">="}, {"==", kComparison, "=="},
    {"!=", kComparison, "!="}, {"<", kComparison, "<"},   {">", kComparison, ">"},
    {"+", kSum, "+"},          {"-", kSum, "-"},          {"*", kProduct, "*"},
    {"/", kProduct, "/"},      {"^", kPower, "pow"},      {"?", kChoice, "if"},
};

struct Constant {
    std::string_view name;
    double value;
};
constexpr Constant kConstants[] = {{"pi", std::numbers::pi}, {"e", std::numbers::e}};

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Reads by precedence climbing (Pratt 1973).
class Parser {
  public:
    explicit Parser(std::string_view text) : text_(text) {}

    std::vector<FormulaTerm> whole() {
        if (text_.size() > kLongest)
            fail(kLongest, fmt::format("is too long: more than {} characters", kLongest));
        skip_spaces();
        if (at_ == text_.size()) fail(0, "is empty: write a number, or an expression in x, y, z and t");
        expression(kChoice);
        if (at_ < text_.size()) fail_after_operand();
        return std::move(terms_);
    }

  private:
    [[noreturn]] static void fail(std::size_t at, const std::string& message) {
        throw FormulaError(at + 1, message);
    }

    [[noreturn]] void fail_after_operand() const {
        const char c = text_[at_];
        if (is_letter(c) || is_digit(c) || c == '(' || c == '.')
            fail(at_, "an operator is missing here; a product is written with *");
        if (c == ')') fail(at_, "this ) closes nothing");
        fail(at_, found_here() + " has no place here");
    }

    std::string found_here() const {
        if (at_ == text_.size()) return "the end";
        const char c = text_[at_];
        return c > ' ' && c < 0x7f ? in_quotes(std::string_view(&c, 1)) : "this character";
    }

    void skip_spaces() {
        while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    }

    bool take(std::string_view sign) {
        if (text_.substr(at_, sign.size()) != sign) return false;
        at_ += sign.size();
        skip_spaces();
        return true;
    }

    void expect(std::string_view sign, std::string_view why) {
        if (!take(sign))
            fail(at_, fmt::format("expected {} {}, found {}", in_quotes(sign), why, found_here()));
    }

    const Sign* sign_here() const {
        for (const Sign& sign : kSigns) {
            if (text_.substr(at_, sign.sign.size()) == sign.sign) return &sign;
        }
        return nullptr;
    }

    // An expression of operators that bind at least as tightly as `level`.
    std::size_t expression(int level) {
        if (++nesting_ > kDeepest) fail(at_, fmt::format("is nested more than {} deep", kDeepest));
        std::size_t left = operand();
        bool compared = false;
        for (const Sign* sign = sign_here(); sign && sign->level >= level; sign = sign_here()) {
            if (sign->level == kComparison && compared)
                fail(at_, "comparisons cannot be chained; multiply them: (0 < x) * (x < 1)");
            compared = sign->level == kComparison;
            const std::size_t begin = at_;
            take(sign->sign);
            left = applied(*sign, left);
            if (sign->operation == "/" && is_zero(terms_[left].arguments[1]))
                fail(begin, "this divides by 0: it has no value anywhere");
        }
        --nesting_;
        return left;
    }

    std::size_t applied(const Sign& sign, std::size_t left) {
        if (sign.level == kChoice) {
            const std::size_t yes = expression(kChoice);
            expect(":", "of the choice a ? b : c");
            return operation(operation_row("if", 3), {left, yes, expression(kChoice)});
        }
        const bool from_the_right = sign.level == kPower;
        const std::size_t right = expression(from_the_right ? sign.level : sign.level + 1);
        return operation(operation_row(sign.operation, 2), {left, right, 0});
    }

    /// Whether a term is 0 everywhere, as a float: what compilers of shaders make of x / 0 is their own affair, and may be any
    /// number.
    bool is_zero(std::size_t term) const {
        const std::optional<double> value = constant(term);
        return value && static_cast<float>(*value) == 0.0f;
    }

    std::optional<double> constant(std::size_t index) const {
        const FormulaTerm& term = terms_[index];
        if (term.kind == FormulaTerm::Kind::Number) return term.number;
        if (term.kind == FormulaTerm::Kind::Variable) return std::nullopt;
        const FormulaOperation& operation = formula_operations()[term.which];
        std::array<double, 3> values{};
        for (std::size_t i = 0; i < operation.arguments; ++i) {
            const std::optional<double> value = constant(term.arguments[i]);
            if (!value) return std::nullopt;
            values[i] = *value;
        }
        return operation.value(values.data());
    }

    std::size_t operand() {
        if (take("-")) return operation(operation_row("-", 1), {expression(kMinus), 0, 0});
        if (take("+")) return expression(kMinus);
        if (take("(")) {
            const std::size_t inside = expression(kChoice);
            expect(")", "to close the bracket");
            return inside;
        }
        if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) return number();
        if (at_ < text_.size() && is_letter(text_[at_])) return name();
        fail(at_, "expected a number, a name or a bracket, found " + found_here());
    }

    std::size_t number() {
        double value = 0.0;
        const char* const begin = text_.data() + at_;
        const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
        if (error == std::errc::result_out_of_range) fail(at_, "this number is too large or too small");
        if (error != std::errc{}) fail(at_, "expected a number, a name or a bracket, found " + found_here());
        at_ += static_cast<std::size_t>(end - begin);
        skip_spaces();
        return add({.kind = FormulaTerm::Kind::Number, .number = value}, 0);
    }

    std::size_t name() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '_'))
            ++at_;
        const std::string_view name = text_.substr(begin, at_ - begin);
        skip_spaces();
        const bool called = at_ < text_.size() && text_[at_] == '(';
        if (const std::optional<std::size_t> row = function_row(name)) {
            if (!called) fail(begin, fmt::format("{0} is a function: write {0}(...)", name));
            return function(*row, begin);
        }
        for (std::size_t i = 0; i < std::size(kFormulaVariables) && !called; ++i) {
            if (name == kFormulaVariables[i])
                return add({.kind = FormulaTerm::Kind::Variable, .which = i}, 0);
        }
        for (const Constant& constant : kConstants) {
            if (name == constant.name && !called)
                return add({.kind = FormulaTerm::Kind::Number, .number = constant.value}, 0);
        }
        std::vector<std::string_view> names = function_names();
        if (!called) {
            names.insert(names.begin(), std::begin(kFormulaVariables), std::end(kFormulaVariables));
            for (const Constant& constant : kConstants) names.push_back(constant.name);
        }
        fail(begin, fmt::format("unknown {} {}; nearest: {}", called ? "function" : "name", in_quotes(name),
                                nearest_first(name, names).front()));
    }

    std::size_t function(std::size_t row, std::size_t begin) {
        const std::string_view name = formula_operations()[row].name;
        const std::size_t wanted = formula_operations()[row].arguments;
        take("(");
        std::array<std::size_t, 3> arguments{};
        std::size_t count = 0;
        do {
            const std::size_t argument = expression(kChoice);
            if (count < arguments.size()) arguments[count] = argument;
            ++count;
        } while (take(","));
        expect(")", fmt::format("after the arguments of {}", name));
        if (count != wanted)
            fail(begin,
                 fmt::format("{} takes {} argument{}, not {}", name, wanted, wanted == 1 ? "" : "s", count));
        return operation(row, arguments);
    }

    std::size_t operation(std::size_t row, const std::array<std::size_t, 3>& arguments) {
        int depth = 0;
        for (std::size_t i = 0; i < formula_operations()[row].arguments; ++i)
            depth = std::max(depth, depths_[arguments[i]] + 1);
        if (depth > kDeepest)
            fail(at_,
                 fmt::format("has more than {} operations inside each other; bracket parts of a long sum",
                             kDeepest));
        return add({.kind = FormulaTerm::Kind::Operation, .which = row, .arguments = arguments}, depth);
    }

    std::size_t add(const FormulaTerm& term, int depth) {
        terms_.push_back(term);
        depths_.push_back(depth);
        return terms_.size() - 1;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int nesting_ = 0;
    std::vector<FormulaTerm> terms_;
    std::vector<int> depths_;  // of the tree under each term
};

}  // namespace

std::vector<FormulaTerm> parse_formula(std::string_view text) {
    return Parser(text).whole();
}

}  // namespace eddy
