#pragma once
#include <span>
#include <string_view>

namespace eddy {

/// A file compiled into the binary by cmake/embed.cmake. `name` is its path from the top of the tree.
struct EmbeddedFile {
    std::string_view name;
    std::string_view text;
};

}  // namespace eddy
