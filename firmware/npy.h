#pragma once
#include <filesystem>
#include <span>
#include <vector>

namespace eddy {

/// Writes 32-bit floats as a NumPy array file (format 1.0, C order: the last index varies fastest).
/// Throws std::runtime_error if the file cannot be written.
void write_npy(const std::filesystem::path& file, std::span<const float> values,
               const std::vector<int>& shape);

}  // namespace eddy
