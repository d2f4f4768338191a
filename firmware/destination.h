#pragma once
#include <filesystem>
#include <string_view>

namespace eddy {

// Where the command line wants its results. Asked before any work begins, so that a wrong path costs a second
// and not an afternoon. Both throw InputError with the option's name, the path and the system's reason.

/// Makes the folder and those above it; it can be written when this returns.
void prepare_folder(std::string_view option, const std::filesystem::path& folder);

/// The file can be made or replaced when this returns; it is not touched.
void check_destination(std::string_view option, const std::filesystem::path& file);

}  // namespace eddy
