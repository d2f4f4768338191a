#pragma once
#include <optional>
#include <string>
#include <vector>

#include "firmware/effects/effect.h"

namespace eddy::effects {

/// A scene with some of its effects.
struct SceneVariant {
    std::string
        name;  ///< "whole scene", "without smoke", "with gravity + smoke", "bodies only", "empty tank"
    EffectNames effects;
    Scene scene;
};

/// Two variants, one of them with an effect that the other does not have.
struct EffectAdded {
    std::size_t with, without;  ///< places in EffectStudy::variants
};

/// Which variants of a scene tell what each of its effects costs.
struct EffectStudy {
    std::vector<SceneVariant> variants;  ///< the first: the whole scene; no two have the same effects

    struct Row {
        std::string_view effect;
        EffectAdded to_whole;  ///< without: also without those that need it
        EffectAdded to_bare;   ///< to the bodies and what it needs; of the bodies, to the empty tank
        std::vector<std::string_view> leaves_with_it;  ///< those that need it
    };
    std::vector<Row> rows;
    EffectAdded all_but_bodies;
};

EffectStudy study_effects(const Scene& scene);

}  // namespace eddy::effects
