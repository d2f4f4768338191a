#pragma once
#include <string>
#include <vector>

namespace eddy {

/// The words on as many lines as it takes so that none is wider than so many ems. A word that is wider alone is not broken.
std::vector<std::string> wrapped(const std::string& words, double ems);

}  // namespace eddy
