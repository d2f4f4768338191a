#pragma once
#include <set>
#include <string_view>
#include <vector>

#include "config/scene.h"

namespace eddy::effects {

/// Something a scene may ask for and can do without.
struct Effect {
    std::string_view name;
    std::vector<std::string_view> needs;  ///< effects without which it is nothing
    bool (*is_in)(const Scene&);
    void (*leave_out)(Scene&);
};

/// All there are, in the order of reports: first the bodies, on which the others are tried.
const std::vector<Effect>& all_effects();
inline constexpr std::string_view kBodies = "bodies";

using EffectNames = std::set<std::string_view>;

/// Those that a scene asks for.
EffectNames effects_of(const Scene& scene);
/// These and all that they need.
EffectNames with_needs(const EffectNames& effects);
/// These without one, and without those that need it.
EffectNames without(const EffectNames& effects, std::string_view one);
/// The scene with these effects of its own and no others.
Scene with_only(Scene scene, const EffectNames& effects);

}  // namespace eddy::effects
