#pragma once
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <span>
#include <string>
#include <vector>

#include "config/value.h"

namespace eddy {

// What options of several verbs have in common.

/// Takes one of these words for an enum; `words` as the configuration writes them.
template <class E>
void choose(CLI::Option& option, std::span<const Word<E>> words) {
    std::string choice;
    for (const Word<E>& word : words) choice += fmt::format("{}{}", choice.empty() ? "" : "|", word.word);
    option.type_name(choice);
    option.transform(CLI::Validator(
        [words, choice](std::string& text) {
            for (const Word<E>& word : words)
                if (word.word == text) {
                    text = std::to_string(static_cast<int>(word.value));
                    return std::string();
                }
            return fmt::format("'{}' is not one of {}", text, choice);
        },
        ""));
}

/// low <= number <= high; a number that is none (nan) is refused too.
CLI::Validator number_from(double low, double high);

/// --set, of verbs that read a scene.
void add_set(CLI::App& verb, std::vector<std::string>& set);

/// --config, of verbs that read an exhibit's settings.
void add_config(CLI::App& verb, std::string& folder,
                const std::string& help = "the exhibit's settings are in this folder");

}  // namespace eddy
