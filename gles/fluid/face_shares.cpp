#include "gles/fluid/face_shares.h"

#include "gles/body/fractions.h"
#include "gles/fluid/pressure.h"
#include "gles/grid_io.h"

namespace eddy::gles {

OnFaces face_shares(Gpu& gpu, const FluidSetup& setup, const std::vector<BodyState>& states) {
    BodyUniforms uniforms(gpu, setup.bodies, setup.cell_m);
    uniforms.set(states);
    Fractions fractions(gpu, multigrid_levels(setup.cells), setup.bodies, setup.cell_m);
    fractions.update(uniforms, std::vector<Box>(states.size(), {glm::ivec3(0), setup.cells}));
    const FaceFractions& a = fractions.level(0);
    const glm::ivec3 n = setup.cells;
    const auto read = [&](const Field<Faces4>& f) {
        return unpack_four(f.texture().download(), f.layout(), n + 1);
    };
    const std::vector<float> x = read(a.x), y = read(a.y), z = read(a.z);
    OnFaces shares{n, {}};
    std::size_t i = 0;
    for (int k = 0; k <= n.z; ++k)
        for (int j = 0; j <= n.y; ++j)
            for (int c = 0; c <= n.x; ++c, ++i) {
                const bool in_x = j < n.y && k < n.z && c > 0 && c < n.x;
                const bool in_y = c < n.x && k < n.z && j > 0 && j < n.y;
                const bool in_z = c < n.x && j < n.y && k > 0 && k < n.z;
                shares.values.emplace_back(in_x ? x[i] : 0.0f, in_y ? y[i] : 0.0f, in_z ? z[i] : 0.0f);
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
