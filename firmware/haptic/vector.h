#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace eddy {

inline bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Shortens v to `longest` and keeps its direction; returns v itself if it is no longer than that. Divides by
/// the largest component first, so that neither 1e300 nor 1e-310 overflows or vanishes on the way.
inline glm::dvec3 shorten(const glm::dvec3& v, double longest) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest == 0.0) return v;
    const glm::dvec3 scaled = v / largest;  // length 1 to sqrt(3)
    const double length = glm::length(scaled);
    return largest * length > longest ? scaled * (longest / length) : v;
}

}  // namespace eddy
