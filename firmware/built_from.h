#pragma once
#include <string_view>

namespace eddy {

/// What `git describe --always --dirty` said of the tree that this program was built from; without git, its version.
extern const std::string_view kBuiltFrom;

}  // namespace eddy
