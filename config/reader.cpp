#include "config/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eddy {
namespace {

std::string found(const Node& node) {
    switch (node.kind) {
        case Node::Kind::Bool:
            return node.boolean ? "true" : "false";
        case Node::Kind::Integer:
            return fmt::format("the whole number {}", node.integer);
        case Node::Kind::Real:
            return fmt::format("the number {}", node.real);
        case Node::Kind::Text:
            return fmt::format("the text {}", in_quotes(node.text));
        case Node::Kind::List:
            return fmt::format("a list of {}", node.children.size());
        case Node::Kind::Table:
            return "a table";
        case Node::Kind::Date:
            break;
    }
    return "a date or time";
}

bool is_number(const Node& node) {
    return node.kind == Node::Kind::Integer || node.kind == Node::Kind::Real;
}

double number(const Node& node) {
    return node.kind == Node::Kind::Integer ? static_cast<double>(node.integer) : node.real;
}

// Why `x` cannot stand under a key with this range; empty if it can.
std::string objection(double x, const Range& range) {
    if (!std::isfinite(x)) return fmt::format("{} is not a finite number", x);
    if (!range.contains(x)) return fmt::format("{} is out of range: must be {}", x, to_string(range));
    return "";
}

}  // namespace

void Reader::finish() {
    for (const Node& entry : table_.children) {
        if (std::find(keys_.begin(), keys_.end(), entry.key) != keys_.end()) continue;
        const auto keys = nearest_first(entry.key, keys_);
        std::string message = "unknown key; nearest valid key: " + std::string(keys.front());
        // Neither a slip of the finger nor a forgotten unit: the whole choice is shown.
        if (2 * edit_distance(entry.key, keys.front()) > entry.key.size() &&
            !keys.front().starts_with(entry.key))
            message += "; valid here: " + fmt::format("{}", fmt::join(keys, ", "));
        findings_.blame(entry.key_place, path_to(entry.key), message);
    }
}

const Node* Reader::take(std::string_view key) {
    if (std::find(keys_.begin(), keys_.end(), key) == keys_.end()) keys_.push_back(key);
    return stands_for_all_ ? &table_ : table_.find(key);
}

std::string Reader::path_to(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

bool Reader::is_list_of_tables(const Node& node, std::string_view key) {
    if (node.kind == Node::Kind::List) return true;
    wrong_type(node, path_to(key), fmt::format("a list of tables, each under [[{}]]", key));
    return false;
}

void Reader::wrong_type(const Node& node, const std::string& path, std::string_view expected) {
    findings_.blame(node.place, path, fmt::format("expected {}, found {}", expected, found(node)));
}

void Reader::wrong_word(const Node& node, const std::string& path,
                        const std::vector<std::string_view>& words) {
    const auto nearest = nearest_first(node.text, words);
    findings_.blame(node.place, path,
                    fmt::format("{} is no word for this key; valid, nearest first: {}", in_quotes(node.text),
                                listed(nearest)));
}

bool Reader::read(const Node& node, const std::string& path, bool& field, const Range&) {
    if (node.kind != Node::Kind::Bool) {
        wrong_type(node, path, type_name(field));
        return false;
    }
    field = node.boolean;
    return true;
}

bool Reader::read(const Node& node, const std::string& path, int& field, const Range& range) {
    if (node.kind != Node::Kind::Integer) {
        wrong_type(node, path, type_name(field));
        return false;
    }
    const Range held_by_int = between(std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
    for (const Range& r : {range, held_by_int}) {
        if (const std::string why = objection(number(node), r); !why.empty()) {
            findings_.blame(node.place, path, why);
            return false;
        }
    }
    field = static_cast<int>(node.integer);
    return true;
}

bool Reader::read(const Node& node, const std::string& path, double& field, const Range& range) {
    if (!is_number(node)) {
        wrong_type(node, path, type_name(field));
        return false;
    }
    if (const std::string why = objection(number(node), range); !why.empty()) {
        findings_.blame(node.place, path, why);
        return false;
    }
    field = number(node);
    return true;
}

bool Reader::read(const Node& node, const std::string& path, glm::ivec3& field, const Range& range) {
    return read_vector(node, path, field, range);
}

bool Reader::read(const Node& node, const std::string& path, glm::dvec3& field, const Range& range) {
    return read_vector(node, path, field, range);
}

bool Reader::read(const Node& node, const std::string& path, FormulaVector& field, const Range& range) {
    return read_vector(node, path, field, range);
}

bool Reader::read(const Node& node, const std::string& path, Formula& field, const Range& range) {
    if (!is_number(node) && node.kind != Node::Kind::Text) {
        wrong_type(node, path, type_name(field));
        return false;
    }
    Formula found;
    try {
        found = is_number(node) ? Formula(number(node)) : Formula::parse(node.text);
    } catch (const FormulaError& error) {
        findings_.blame(node.place, path,
                        fmt::format("no good formula, at its character {}: {}", error.column, error.what()));
        return false;
    }
    // What varies is known only where and when it is evaluated.
    const std::string why = found.constant() ? objection(*found.constant(), range) : "";
    if (!why.empty()) {
        findings_.blame(node.place, path, why);
        return false;
    }
    field = found;
    return true;
}

bool Reader::read(const Node& node, const std::string& path, std::string& field, const Range&) {
    if (node.kind != Node::Kind::Text) {
        wrong_type(node, path, type_name(field));
        return false;
    }
    field = node.text;
    return true;
}

bool Reader::read(const Node& node, const std::string& path, std::filesystem::path& field, const Range&) {
    std::string text;
    if (!read(node, path, text, {})) return false;
    if (text.empty() || text.find('\0') != std::string::npos) {
        wrong_type(node, path, type_name(field));
        return false;
    }
    field = text;
    return true;
}

}  // namespace eddy
