#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostic.h"

namespace eddy {

/// A TOML value that knows where it stands. The only form in which TOML leaves document.cpp.
struct Node {
    enum class Kind { Bool, Integer, Real, Text, List, Table, Date };

    Kind kind = Kind::Table;
    Place place;      // of the value; for a table, of its header
    std::string key;  // its name in the table around it; empty in a list
    Place key_place;

    bool boolean = false;
    std::int64_t integer = 0;
    double real = 0.0;
    std::string text;
    std::vector<Node> children;  // elements of a list, entries of a table (no key twice)

    const Node* find(std::string_view name) const;
    Node* find(std::string_view name);
};

/// What a file may hold, so that one which nobody wrote by hand is refused at once: checks compare bodies with bodies, keys
/// with keys. A scene has some dozens of values.
inline constexpr std::size_t kMostEntries = 1000;  ///< of a list or a table
inline constexpr std::size_t kMostValues = 20000;
inline constexpr int kMostNames = 16;  ///< of a key: body.0.material.name has four

/// Reads TOML text. `file` is what diagnostics call it. Throws ConfigError on a syntax error, or if it holds more than that.
Node parse_toml(std::string_view text, const std::string& file);

/// Adds the entries of `over` to `base`: tables are merged, everything else is replaced. Places travel along.
void merge(Node& base, const Node& over);

/// The text of a file. Throws ConfigError if it cannot be read.
std::string read_file(const std::string& path);

}  // namespace eddy
