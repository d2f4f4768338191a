#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace eddy {

/// Files of the folder whose names begin and end so, those with the latest time in their names first. Empty if it cannot be read.
std::vector<std::filesystem::path> dated_files(const std::filesystem::path& folder, std::string_view prefix,
                                               std::string_view extension);

/// One that is not there yet: with -2, -3, ... before the extension where it has to be.
std::filesystem::path unused_file(const std::filesystem::path& folder, const std::string& stem,
                                  std::string_view extension);

/// Removes the last beyond `most` of files as dated_files() gives them, but not `written`, which has just come: the clock may have
/// gone back since the others did.
void keep_newest(const std::vector<std::filesystem::path>& files, std::size_t most,
                 const std::filesystem::path& written);

}  // namespace eddy
