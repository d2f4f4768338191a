#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace eddy {

/// How many letters must be added, dropped, replaced or swapped with their neighbour to turn one word into
/// the other. (Optimal string alignment distance.)
std::size_t edit_distance(std::string_view a, std::string_view b);

/// `words`, the nearest to `word` first; equally near ones keep their order.
std::vector<std::string_view> nearest_first(std::string_view word, std::vector<std::string_view> words);

/// `words` in quotes, separated by commas.
std::string listed(const std::vector<std::string_view>& words);

}  // namespace eddy
