#include "gles/fluid/face_shares.h"

#include "gles/body/fractions.h"

namespace eddy::gles {

OnFaces face_shares(Gpu& gpu, const FluidSetup& setup, const std::vector<BodyState>& states) {
    BodyUniforms uniforms(gpu, setup.bodies, setup.cell_m);
    uniforms.set(states);
    Fractions fractions(gpu, {setup.cells}, setup.bodies, setup.cell_m);
    fractions.update(uniforms, {});  // the first time it draws everything
    const glm::ivec3 n = setup.cells;
    OnFaces shares{n, {}};
    for (const glm::vec3& a : fractions.level(0).download()) shares.values.emplace_back(a);
    for (int z = 0; z <= n.z; ++z)
        for (int y = 0; y <= n.y; ++y)
            for (int x = 0; x <= n.x; ++x) {
                const glm::ivec3 c(x, y, z);
                const glm::bvec3 on_upper = glm::equal(c, n), on_lower = glm::equal(c, glm::ivec3(0));
                for (int k = 0; k < 3; ++k)
                    if (on_lower[k] || glm::any(on_upper)) shares.values[shares.index(c)][k] = 0.0;
            }
    return shares;
}

glm::dvec3 sum(const OnFaces& a, const std::vector<glm::vec3>& u) {
    glm::dvec3 total(0.0);
    for (std::size_t i = 0; i < u.size(); ++i) total += a.values[i] * glm::dvec3(u[i]);
    return total;
}

double sum_of_squares(const OnFaces& a, const std::vector<glm::vec3>& u) {
    double total = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i)
        total += glm::dot(a.values[i], glm::dvec3(u[i]) * glm::dvec3(u[i]));
    return total;
}

}  // namespace eddy::gles
