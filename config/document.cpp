#include "config/document.h"

// toml++ 3.3 asserts, before it reports them, that some mistakes in its input (such as "[=") cannot be. Its
// assertions would end a debug build and, where NDEBUG turns them into promises to the compiler (clang),
// leave the result undefined. The checks after them are right, so the assertions are made to say nothing.
#undef NDEBUG
#define TOML_ASSERT(expr) static_assert(true)
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace eddy {
namespace {

Place place_at(const toml::source_position& position, const std::string& file) {
    return {file, static_cast<int>(position.line), static_cast<int>(position.column)};
}

Node convert(const toml::node& from, const std::string& file) {
    Node node;
    node.place = place_at(from.source().begin, file);
    if (const toml::table* table = from.as_table()) {
        node.kind = Node::Kind::Table;
        for (const auto& [key, value] : *table) {
            Node& child = node.children.emplace_back(convert(value, file));
            child.key = key.str();
            child.key_place = place_at(key.source().begin, file);
        }
    } else if (const toml::array* array = from.as_array()) {
        node.kind = Node::Kind::List;
        for (const toml::node& value : *array) node.children.push_back(convert(value, file));
    } else if (const auto* text = from.as_string()) {
        node.kind = Node::Kind::Text;
        node.text = text->get();
    } else if (const auto* integer = from.as_integer()) {
        node.kind = Node::Kind::Integer;
        node.integer = integer->get();
    } else if (const auto* real = from.as_floating_point()) {
        node.kind = Node::Kind::Real;
        node.real = real->get();
    } else if (const auto* boolean = from.as_boolean()) {
        node.kind = Node::Kind::Bool;
        node.boolean = boolean->get();
    } else {
        node.kind = Node::Kind::Date;
    }
    return node;
}

}  // namespace

const Node* Node::find(std::string_view name) const {
    const auto found =
        std::find_if(children.begin(), children.end(), [&](const Node& n) { return n.key == name; });
    return found == children.end() ? nullptr : &*found;
}

Node* Node::find(std::string_view name) {
    const auto found =
        std::find_if(children.begin(), children.end(), [&](const Node& n) { return n.key == name; });
    return found == children.end() ? nullptr : &*found;
}

Node parse_toml(std::string_view text, const std::string& file) {
    try {
        Node root = convert(toml::parse(text), file);
        root.place = {file, 1, 1};
        return root;
    } catch (const toml::parse_error& error) {
        throw ConfigError(
            {diagnose(place_at(error.source().begin, file), "", std::string(error.description()))});
    }
}

void merge(Node& base, const Node& over) {
    for (const Node& entry : over.children) {
        Node* old = base.find(entry.key);
        if (!old)
            base.children.push_back(entry);
        else if (old->kind == Node::Kind::Table && entry.kind == Node::Kind::Table)
            merge(*old, entry);
        else
            *old = entry;
    }
}

std::string read_file(const std::string& path) {
    const auto unreadable = [&](const std::string& why) {
        return ConfigError({diagnose({path, 0, 0}, "", fmt::format("cannot be read: {}", why))});
    };
    // A folder opens like a file and fails only when it is read.
    if (std::error_code error; std::filesystem::is_directory(path, error)) throw unreadable("it is a folder");
    std::ifstream in(path, std::ios::binary);
    if (!in) throw unreadable(std::strerror(errno));
    try {
        return {std::istreambuf_iterator<char>(in), {}};
    } catch (const std::ios_base::failure& failure) {
        throw unreadable(failure.what());
    }
}

}  // namespace eddy
