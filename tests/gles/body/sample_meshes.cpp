#include "tests/gles/body/sample_meshes.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace eddy::gles {

TriangleMesh icosphere(double radius, int times, const glm::dvec3& centre) {
    const double t = (1.0 + std::sqrt(5.0)) / 2.0;
    TriangleMesh mesh;
    mesh.corners = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                    {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (glm::dvec3& x : mesh.corners) x = glm::normalize(x);
    for (int n = 0; n < times; ++n) {
        std::map<std::pair<unsigned, unsigned>, unsigned> middles;
        const auto middle = [&](unsigned a, unsigned b) {
            const auto [at, is_new] =
                middles.try_emplace({std::min(a, b), std::max(a, b)}, mesh.corners.size());
            if (is_new) mesh.corners.push_back(glm::normalize(mesh.corners[a] + mesh.corners[b]));
            return at->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& f : mesh.triangles) {
            const unsigned a = middle(f.x, f.y), b = middle(f.y, f.z), c = middle(f.z, f.x);
            finer.insert(finer.end(), {{f.x, a, c}, {f.y, b, a}, {f.z, c, b}, {a, b, c}});
        }
        mesh.triangles = finer;
    }
    for (glm::dvec3& x : mesh.corners) x = centre + radius * x;
    return mesh;
}

TriangleMesh box_mesh(const glm::dvec3& low, const glm::dvec3& high) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.corners.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

std::string binary_stl(const TriangleMesh& mesh) {
    std::string bytes(80, ' ');
    const auto put = [&](std::uint32_t value, int count) {
        for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 255u);
    };
    put(static_cast<std::uint32_t>(mesh.triangles.size()), 4);
    for (const glm::uvec3& t : mesh.triangles) {
        for (int k = 0; k < 3; ++k) put(0, 4);
        for (int k = 0; k < 9; ++k)
            put(std::bit_cast<std::uint32_t>(static_cast<float>(mesh.corners[t[k / 3]][k % 3])), 4);
        put(0, 2);
    }
    return bytes;
}

std::string text_stl(const TriangleMesh& mesh) {
    std::string text = "solid thing\n";
    for (const glm::uvec3& t : mesh.triangles) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 x(mesh.corners[t[k]]);
            text += fmt::format("      vertex {:e} {:e} {:e}\n", x.x, x.y, x.z);
        }
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid thing\n";
}

std::string obj(const TriangleMesh& mesh) {
    std::string text = "# a thing\no thing\n";
    for (const glm::dvec3& c : mesh.corners) {
        const glm::vec3 x(c);
        text += fmt::format("v {} {} {}\n", x.x, x.y, x.z);
    }
    for (const glm::uvec3& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    return text;
}

}  // namespace eddy::gles
