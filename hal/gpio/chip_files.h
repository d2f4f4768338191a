#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace eddy {

/// The device files gpiochip0, gpiochip1, ... of a folder, in the order of their numbers.
std::vector<std::filesystem::path> chip_files(const std::filesystem::path& folder);

/// Why one of them could not be opened, and what to do. `error` as errno has it.
std::string why_not_opened(const std::filesystem::path& file, int error);

}  // namespace eddy
