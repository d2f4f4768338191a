#pragma once
#include "firmware/accuracy/case.h"

namespace eddy::accuracy {

/// Something that must hold of any flow, whatever its solution is, measured as an exhibit computes: with the cycles and the
/// step of the presets fast and precise.
struct Identity {
    std::string name = {}, title = {};
    std::string scene = "validation/B8";
    std::vector<Quantity> quantities = {};  ///< of each preset
    std::function<std::vector<double>(Laboratory&, const Scene&)> measure = {};
    std::vector<int> quick = {25}, full = {25, 50};
};

Case at_both_presets(const Identity& identity);

}  // namespace eddy::accuracy
