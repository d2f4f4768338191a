#include "firmware/effects/study.h"

#include <algorithm>

namespace eddy::effects {
namespace {

class Builder {
  public:
    explicit Builder(const Scene& scene) : scene_(scene), all_(effects_of(scene)) {
        if (all_.contains(kBodies)) bare_.insert(kBodies);
        add("whole scene", all_);
        study_.all_but_bodies = {0, add(only(bare_), bare_)};
    }

    EffectStudy build() {
        std::vector<std::string_view> order;
        for (const Effect& effect : all_effects())
            if (all_.contains(effect.name)) order.push_back(effect.name);
        for (const std::string_view name : order) {
            const EffectNames rest = effects::without(all_, name);
            EffectStudy::Row row{name, {0, add("without " + std::string(name), rest)}, {}, {}};
            for (const std::string_view other : order)
                if (other != name && !rest.contains(other)) row.leaves_with_it.push_back(other);
            study_.rows.push_back(std::move(row));
        }
        for (EffectStudy::Row& row : study_.rows) {
            EffectNames alone = with_needs({row.effect});
            alone.insert(bare_.begin(), bare_.end());
            EffectNames before = alone;
            before.erase(row.effect);
            row.to_bare = {add(only(alone), alone), add(only(before), before)};
        }
        return std::move(study_);
    }

  private:
    /// The place of the variant with these effects; one that is there already keeps its name.
    std::size_t add(std::string name, const EffectNames& effects) {
        std::vector<SceneVariant>& all = study_.variants;
        const auto same =
            std::find_if(all.begin(), all.end(), [&](const SceneVariant& v) { return v.effects == effects; });
        if (same != all.end()) return static_cast<std::size_t>(same - all.begin());
        all.push_back({std::move(name), effects, with_only(scene_, effects)});
        return all.size() - 1;
    }

    std::string only(const EffectNames& effects) const {
        if (effects.empty()) return "empty tank";
        std::string names;
        for (const Effect& effect : all_effects())
            if (effects.contains(effect.name) && !bare_.contains(effect.name))
                names += (names.empty() ? "with " : " + ") + std::string(effect.name);
        return names.empty() ? "bodies only" : names;
    }

    const Scene& scene_;
    EffectNames all_, bare_;
    EffectStudy study_;
};

}  // namespace

EffectStudy study_effects(const Scene& scene) {
    return Builder(scene).build();
}

}  // namespace eddy::effects
