#pragma once
#include <fmt/format.h>

#include <concepts>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostic.h"
#include "config/formula.h"

// What a key of the schema can hold, how it is called in messages and how it is written in TOML.

namespace eddy {

/// The numbers a key accepts. For a vector, each component. Numbers that are not finite are never accepted.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_excluded = false;

    bool contains(double x) const { return (low_excluded ? x > low : x >= low) && x <= high; }
};
constexpr Range at_least(double low) {
    return {.low = low};
}
constexpr Range between(double low, double high) {
    return {.low = low, .high = high};
}
constexpr Range above(double low) {
    return {.low = low, .low_excluded = true};
}
constexpr Range above(double low, double high) {
    return {.low = low, .high = high, .low_excluded = true};
}

/// "above 0 and at most 1"; empty for any number.
std::string to_string(const Range& range);

/// One word of an enumeration, and what it stands for.
template <class Enum>
struct Word {
    Enum value;
    std::string_view word;
    std::string_view doc;
};

/// An enumeration that can be written in TOML: words_of(Enum) returns its words.
template <class T>
concept Worded = requires(T value) {
    { words_of(value) } -> std::convertible_to<std::span<const Word<T>>>;
};

template <Worded Enum>
std::string_view to_word(Enum value) {
    for (const Word<Enum>& w : words_of(value)) {
        if (w.value == value) return w.word;
    }
    return "?";
}

/// Nothing if no value has this word.
template <Worded Enum>
std::optional<Enum> from_word(std::string_view word) {
    for (const Word<Enum>& w : words_of(Enum{})) {
        if (w.word == word) return w.value;
    }
    return std::nullopt;
}

template <Worded Enum>
std::vector<std::string_view> all_words() {
    std::vector<std::string_view> words;
    for (const Word<Enum>& w : words_of(Enum{})) words.push_back(w.word);
    return words;
}

// The type of a value, as messages and the reference call it.
constexpr std::string_view type_name(bool) {
    return "true or false";
}
constexpr std::string_view type_name(int) {
    return "a whole number";
}
constexpr std::string_view type_name(double) {
    return "a number";
}
constexpr std::string_view type_name(const glm::ivec3&) {
    return "a list of 3 whole numbers";
}
constexpr std::string_view type_name(const glm::dvec3&) {
    return "a list of 3 numbers";
}
inline std::string_view type_name(const Formula&) {
    return "a number or a formula";
}
inline std::string_view type_name(const FormulaVector&) {
    return "a list of 3 numbers or formulas";
}
inline std::string_view type_name(const std::string&) {
    return "text";
}
inline std::string_view type_name(const std::filesystem::path&) {
    return "a file name";
}
template <Worded Enum>
std::string_view type_name(Enum) {
    return "a word";
}
template <Worded Enum>
std::string_view type_name(const std::vector<Enum>&) {
    return "a list of words";
}

// A value as TOML; reading it back gives the same bits.
std::string to_toml(bool value);
std::string to_toml(int value);
std::string to_toml(double value);
std::string to_toml(const glm::ivec3& value);
std::string to_toml(const glm::dvec3& value);
std::string to_toml(const Formula& value);
std::string to_toml(const FormulaVector& value);
std::string to_toml(const std::string& value);
std::string to_toml(const std::filesystem::path& value);
template <Worded Enum>
std::string to_toml(Enum value) {
    return in_quotes(to_word(value));
}
template <Worded Enum>
std::string to_toml(const std::vector<Enum>& values) {
    std::string out;
    for (const Enum value : values) out += fmt::format("{}{}", out.empty() ? "" : ", ", to_toml(value));
    return fmt::format("[{}]", out);
}

}  // namespace eddy
