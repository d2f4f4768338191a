#pragma once
#include <filesystem>
#include <span>
#include <vector>

namespace eddy {

// NumPy array files, as numpy.save() and numpy.load() know them (numpy.lib.format): 32-bit floats in C order, the
// last index varies fastest.

/// Throws std::runtime_error if the file cannot be written.
void write_npy(const std::filesystem::path& file, std::span<const float> values,
               const std::vector<int>& shape);

struct NpyArray {
    std::vector<int> shape;
    std::vector<float> values;
};
/// Throws InputError, with the file and the cure, if it is not such a file.
NpyArray read_npy(const std::filesystem::path& file);

}  // namespace eddy
