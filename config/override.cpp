#include "config/override.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace eddy {
namespace {

struct Step {
    std::string word;
    Place place;
};

// Splits "body.ball.radius_m" at the dots, remembering where each word stands.
std::vector<Step> steps_of(std::string_view path, int number) {
    std::vector<Step> steps;
    std::size_t begin = 0;
    while (begin <= path.size()) {
        const std::size_t end = std::min(path.find('.', begin), path.size());
        const int column = static_cast<int>(begin) + 1;
        steps.push_back(
            {std::string(path.substr(begin, end - begin)), {std::string(kOverrideFile), number, column}});
        begin = end + 1;
    }
    return steps;
}

// The value, read at the line and column it has in the override: blank lines and spaces stand for what is
// before it.
Node value_of(std::string_view text, std::size_t equals, int number) {
    std::string padded(static_cast<std::size_t>(number - 1), '\n');
    padded += 'v';
    padded.append(equals - 1, ' ');
    padded += text.substr(equals);
    Node document = parse_toml(padded, std::string(kOverrideFile));
    if (document.children.size() != 1)
        throw ConfigError(
            {diagnose({std::string(kOverrideFile), number, 1}, "", "holds more than one value")});
    return document.children.front();
}

bool is_bare_word(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-' || c == '.' || c == '/';
    });
}

// The element of [[key]] that `word` means: its number from 0, its name, or, if it has none, the name that
// resolve() will give it.
Node* element(Node& list, std::string_view word) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error == std::errc{} && end == word.data() + word.size())
        return index < list.children.size() ? &list.children[index] : nullptr;
    for (std::size_t i = 0; i < list.children.size(); ++i) {
        const Node* name = list.children[i].find("name");
        const std::string called = name ? name->text : list.key + std::to_string(i + 1);
        if (called == word) return &list.children[i];
    }
    return nullptr;
}

Node empty_table(const Step& step) {
    Node table;
    table.kind = Node::Kind::Table;
    table.place = table.key_place = step.place;
    table.key = step.word;
    return table;
}

// What `word` names inside `node`; a table gets an empty table under that name when it has none.
Node* inside(Node& node, const Step& step, std::string& objection) {
    if (node.kind == Node::Kind::Table) {
        if (Node* entry = node.find(step.word)) return entry;
        return &node.children.emplace_back(empty_table(step));
    }
    if (node.kind == Node::Kind::List) {
        if (Node* found = element(node, step.word)) return found;
        objection = fmt::format("no element {} in a list of {}; count from 0 or use its name",
                                in_quotes(step.word), node.children.size());
        return nullptr;
    }
    objection =
        fmt::format("{} is inside something that is neither a table nor a list", in_quotes(step.word));
    return nullptr;
}

}  // namespace

void apply_override(Node& document, std::string_view text, int number, std::vector<Diagnostic>& diagnostics) {
    const std::size_t equals = text.find('=');
    const std::string path(text.substr(0, equals));
    const std::vector<Step> steps = steps_of(path, number);
    const auto blame = [&](const Place& place, const std::string& message) {
        diagnostics.push_back(diagnose(place, path, message));
    };
    for (const Step& step : steps) {
        if (step.word.empty() || equals == std::string_view::npos)
            return blame(step.place, "expected key=value, as in solver.dt_s=0.01");
    }

    Node value;
    try {
        value = value_of(text, equals, number);
    } catch (const ConfigError& error) {
        const Diagnostic& first = error.diagnostics().front();
        const std::string_view word = text.substr(equals + 1);
        const std::string cure =
            is_bare_word(word) ? fmt::format("; text needs quotes: {}={}", path, in_quotes(word)) : "";
        return blame({first.file, first.line, first.column}, first.message + cure);
    }

    Node* node = &document;
    std::string objection;
    for (const Step& step : steps) {
        node = inside(*node, step, objection);
        if (!node) return blame(step.place, objection);
    }
    value.key = node->key;
    value.key_place = steps.back().place;
    *node = std::move(value);
}

}  // namespace eddy
