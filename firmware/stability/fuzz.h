#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "config/scene.h"
#include "gles/gpu.h"

namespace eddy::stability {

struct Violation {
    std::string reason;  ///< in words; empty: there is none
    long step = 0;       ///< it was seen after; or all there were
};
/// Runs a scene as it is written, a held body staying where it is, until it breaks the rule (rule.h).
Violation first_violation(gles::Gpu& gpu, const Scene& scene, long steps);

struct FuzzFinding {
    std::uint64_t seed = 0;
    std::string violation;       ///< of the scene as it was drawn
    std::filesystem::path file;  ///< the smallest scene found that still breaks the rule
};

struct FuzzPlan {
    std::uint64_t first_seed = 1;
    int scenes = 50;
    long steps = 200;
    std::filesystem::path folder = {};  ///< for scene files; must be there
};

/// Random scenes, one for each seed. `on_scene` hears each seed before it runs.
std::vector<FuzzFinding> fuzz(gles::Gpu& gpu, const FuzzPlan& plan,
                              const std::function<void(std::uint64_t seed)>& on_scene = {});

}  // namespace eddy::stability
