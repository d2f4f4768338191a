#include "hal/haptic/emulated/axis_map.h"

#include <fmt/format.h>

#include <stdexcept>

namespace eddy::emulated {
namespace {

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
    throw std::invalid_argument(
        fmt::format("axis mapping '{}' {}: name each of x, y, z once, as in x,z,-y", text, why));
}

}  // namespace

AxisMap::AxisMap(std::string_view text) {
    std::array<bool, 3> used{};
    std::string_view rest = text;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
        const std::size_t comma = rest.find(',');
        const bool last = i + 1 == terms_.size();
        if (last != (comma == std::string_view::npos)) refuse(text, "does not have three parts");
        std::string_view term = rest.substr(0, comma);
        if (!last) rest.remove_prefix(comma + 1);

        const bool negative = !term.empty() && term.front() == '-';
        if (negative) term.remove_prefix(1);
        if (term.size() != 1 || term[0] < 'x' || term[0] > 'z')
            refuse(text, fmt::format("has '{}' for an axis", term));
        const int axis = term[0] - 'x';
        if (used[static_cast<std::size_t>(axis)]) refuse(text, fmt::format("uses {} twice", term));
        used[static_cast<std::size_t>(axis)] = true;
        terms_[i] = {axis, negative ? -1.0 : 1.0};
    }
}

glm::dvec3 AxisMap::operator()(const glm::dvec3& source) const {
    return {terms_[0].sign * source[terms_[0].axis], terms_[1].sign * source[terms_[1].axis],
            terms_[2].sign * source[terms_[2].axis]};
}

}  // namespace eddy::emulated
