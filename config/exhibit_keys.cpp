#include "config/exhibit_keys.h"

#include <algorithm>

namespace eddy {

bool ExhibitKeys::has(std::string_view path) const {
    return std::any_of(keys_.begin(), keys_.end(), [&](const Key& key) { return key.path == path; });
}

bool ExhibitKeys::has_inside(std::string_view table) const {
    const std::string inside = std::string(table) + ".";
    return std::any_of(keys_.begin(), keys_.end(),
                       [&](const Key& key) { return key.path.starts_with(inside); });
}

std::vector<KeyChange> ExhibitKeys::changes_since(const ExhibitKeys& before) const {
    std::vector<KeyChange> changes;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        const Key &from = before.keys_[i], &to = keys_[i];
        if (!to.same(from.field, to.field)) changes.push_back({to.path, to.takes_effect, from.toml, to.toml});
    }
    return changes;
}

void ExhibitKeys::keep(const ExhibitKeys& before, const std::function<bool(TakesEffect)>& kept) const {
    for (std::size_t i = 0; i < keys_.size(); ++i)
        if (kept(keys_[i].takes_effect)) keys_[i].copy(keys_[i].field, before.keys_[i].field);
}

}  // namespace eddy
