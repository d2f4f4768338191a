#pragma once
#include <random>

#include "gles/fluid/setup.h"
#include "gles/grid_io.h"
#include "gles/yang2009/voxels.h"

namespace eddy::gles {

/// A sphere in an odd little tank as plain numbers: what the voxel passes are compared with. All in cells, h
/// = 1.
struct VoxelGrid {
    glm::ivec3 n{11, 9, 13};
    glm::dvec3 centre{5.2, 4.4, 6.7};
    double radius = 2.6;
    glm::dvec3 velocity{0.5, -0.25, 2.0}, spin{0.0, 0.0, 0.0};

    std::size_t index(const glm::ivec3& c) const {
        return static_cast<std::size_t>((c.z * n.y + c.y) * n.x + c.x);
    }
    std::size_t count() const { return static_cast<std::size_t>(n.x * n.y * n.z); }
    bool in_tank(const glm::ivec3& c) const {
        return glm::all(glm::greaterThanEqual(c, glm::ivec3(0))) && glm::all(glm::lessThan(c, n));
    }
    bool solid(const glm::ivec3& c) const {
        return in_tank(c) && glm::length(glm::dvec3(c) + 0.5 - centre) < radius;
    }
    template <class F>
    void for_each_cell(F f) const {
        for (int z = 0; z < n.z; ++z)
            for (int y = 0; y < n.y; ++y)
                for (int x = 0; x < n.x; ++x) f(glm::ivec3(x, y, z));
    }

    std::vector<BodySetup> bodies() const { return {BodySetup{Sphere{radius}}}; }
    BodyState state() const {
        BodyState s;
        s.centre_m = centre;
        s.velocity_m_s = velocity;
        s.spin_rad_s = spin;
        return s;
    }
    /// T_IO of this sphere.
    Voxels voxels(Gpu& gpu) const {
        Voxels v(gpu, n, bodies());
        v.update(uniforms(gpu));
        return v;
    }
    BodyUniforms uniforms(Gpu& gpu) const {
        BodyUniforms u(gpu, bodies(), 1.0);
        u.set({state()});
        return u;
    }
    /// Numbers in [-1, 1], the same for the same seed.
    std::vector<float> random_field(unsigned seed) const {
        std::mt19937 random(seed);
        std::vector<float> field(count());
        for (float& value : field)
            value = 2.0f * static_cast<float>(random()) / static_cast<float>(random.max()) - 1.0f;
        return field;
    }
    std::vector<glm::vec3> random_velocity(unsigned seed) const {
        const std::vector<float> x = random_field(seed), y = random_field(seed + 1),
                                 z = random_field(seed + 2);
        std::vector<glm::vec3> u(count());
        for (std::size_t i = 0; i < u.size(); ++i) u[i] = {x[i], y[i], z[i]};
        return u;
    }
    Field<Cells> upload(Gpu& gpu, const std::vector<glm::vec3>& values) const {
        Field<Cells> field(gpu, n, Format::RGBA32F);
        field.texture().upload(&pack_vectors(values, field.layout())[0].x);
        return field;
    }
    /// A field of one channel with these values.
    Field<Cells> upload(Gpu& gpu, const std::vector<float>& values) const {
        Field<Cells> field(gpu, n, Format::R32F);
        const glm::ivec2 size = field.layout().texels();
        std::vector<float> texels(static_cast<std::size_t>(size.x * size.y));
        for_each_cell([&](const glm::ivec3& c) {
            const glm::ivec2 t = field.layout().texel(c);
            texels[static_cast<std::size_t>(t.y * size.x + t.x)] = values[index(c)];
        });
        field.texture().upload(texels.data());
        return field;
    }
};

/// h = 1 m and rho = 1, so that every number is in cells.
inline FluidSetup unit_setup(const glm::ivec3& n, int sweeps) {
    FluidSetup s;
    s.cells = n;
    s.cell_m = 1.0;
    s.density_kg_m3 = 1.0;
    s.solver.method = Method::Yang2009;
    s.solver.jacobi_sweeps = sweeps;
    return s;
}

inline const glm::ivec3 kSixWays[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

struct ForceAndMoment {
    glm::dvec3 force{0.0}, moment{0.0};
};

/// sigma n over the faces between sphere and fluid, phi from the fluid's side and the stress
/// k (du_i/dx_j + du_j/dx_i) at the face's centre, where the moment is taken too.
template <class P, class V>
ForceAndMoment sum_over_faces(const VoxelGrid& grid, const std::vector<P>& phi, const std::vector<V>& u,
                              double k) {
    const auto u_at = [&](const glm::ivec3& c) {
        return glm::dvec3(u[grid.index(glm::clamp(c, glm::ivec3(0), grid.n - 1))]);
    };
    ForceAndMoment sum;
    grid.for_each_cell([&](const glm::ivec3& c) {
        if (!grid.solid(c)) return;
        for (const glm::ivec3& n : kSixWays) {
            if (!grid.in_tank(c + n) || grid.solid(c + n)) continue;
            glm::dmat3 du;  // du[j][i] = du_i / dx_j
            for (int j = 0; j < 3; ++j) {
                glm::ivec3 e(0);
                e[j] = 1;
                du[j] = n[j] != 0 ? static_cast<double>(n[j]) * (u_at(c + n) - u_at(c))
                                  : 0.25 * (u_at(c + e) - u_at(c - e) + u_at(c + n + e) - u_at(c + n - e));
            }
            const glm::dmat3 sigma =
                glm::dmat3(-static_cast<double>(phi[grid.index(c + n)])) + k * (du + glm::transpose(du));
            const glm::dvec3 f = sigma * glm::dvec3(n);
            sum.force += f;
            sum.moment += glm::cross(glm::dvec3(c) + 0.5 + 0.5 * glm::dvec3(n) - grid.centre, f);
        }
    });
    return sum;
}

/// Jacobi sweeps of (1 - k laplacian) u = u* from u*; the sphere's velocity stays, walls are mirrors.
inline std::vector<glm::dvec3> diffused(const VoxelGrid& grid, const std::vector<glm::dvec3>& star, double k,
                                        int sweeps) {
    std::vector<glm::dvec3> u = star, next = star;
    for (int s = 0; s < sweeps; ++s) {
        grid.for_each_cell([&](const glm::ivec3& c) {
            if (grid.solid(c)) return;
            glm::dvec3 sum(0.0);
            for (const glm::ivec3& e : kSixWays)
                sum += grid.in_tank(c + e) ? u[grid.index(c + e)]
                                           : u[grid.index(c)] * (1.0 - 2.0 * glm::dvec3(glm::abs(e)));
            next[grid.index(c)] = (star[grid.index(c)] + k * sum) / (1.0 + 6.0 * k);
        });
        u.swap(next);
    }
    return u;
}

}  // namespace eddy::gles
