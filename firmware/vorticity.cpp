#include "firmware/vorticity.h"

namespace eddy {
namespace {

std::size_t index(const glm::ivec3& c, const glm::ivec3& size) {
    return static_cast<std::size_t>(c.x + size.x * (c.y + size.y * c.z));
}

template <class F>
void for_each_cell(const glm::ivec3& n, F f) {
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x) f(glm::ivec3(x, y, z));
}

}  // namespace

std::vector<glm::vec3> velocity_in_cells(const std::vector<glm::vec3>& u, const glm::ivec3& n) {
    if (u.size() == static_cast<std::size_t>(n.x * n.y * n.z)) return u;
    std::vector<glm::vec3> middle;
    for_each_cell(n, [&](const glm::ivec3& c) {
        const auto at = [&](const glm::ivec3& face) { return u[index(face, n + 1)]; };
        middle.push_back(0.5f *
                         (at(c) + glm::vec3(at(c + glm::ivec3(1, 0, 0)).x, at(c + glm::ivec3(0, 1, 0)).y,
                                            at(c + glm::ivec3(0, 0, 1)).z)));
    });
    return middle;
}

std::vector<glm::vec3> vorticity(const std::vector<glm::vec3>& velocity_m_s, const glm::ivec3& n,
                                 double cell_m) {
    const std::vector<glm::vec3> u = velocity_in_cells(velocity_m_s, n);
    std::vector<glm::vec3> curl;
    for_each_cell(n, [&](const glm::ivec3& c) {
        const auto slope = [&](const glm::ivec3& along) {
            const glm::ivec3 low = glm::max(c - along, glm::ivec3(0)), high = glm::min(c + along, n - 1);
            const double distance_m = cell_m * glm::length(glm::dvec3(high - low));
            return (u[index(high, n)] - u[index(low, n)]) / static_cast<float>(distance_m);
        };
        const glm::vec3 dx = slope({1, 0, 0}), dy = slope({0, 1, 0}), dz = slope({0, 0, 1});
        curl.emplace_back(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x);
    });
    return curl;
}

}  // namespace eddy
