#include "gles/fluid/viscous_term.h"

#include <cmath>
#include <numbers>
#include <random>

#include "gles/grid_io.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

/// Cells of 1 m, density 1, steps of 1 s: viscosity_pa_s is nu dt / h^2.
class ViscousStep : public GlTest {
  protected:
    struct Tank {
        FluidSetup setup;
        Walls walls;
        ViscousTerm term;
        BodyUniforms bodies;
    };
    std::unique_ptr<Tank> tank(const glm::ivec3& n, double lambda, WallKind kind, double radius) {
        FluidSetup s;
        s.cells = n;
        s.cell_m = s.density_kg_m3 = 1.0;
        s.viscosity_pa_s = lambda;
        for (WallSetup& w : s.walls) w.kind = kind;
        if (radius > 0.0) s.bodies = {BodySetup{Sphere{radius}}};
        setup_ = std::make_unique<FluidSetup>(s);
        walls_ = std::make_unique<Walls>(*setup_);
        auto t = std::make_unique<Tank>(
            Tank{s, *walls_, ViscousTerm(gpu, *setup_, *walls_), BodyUniforms(gpu, s.bodies, 1.0)});
        if (radius > 0.0) {
            const BodyState state{.centre_m = 0.5 * glm::dvec3(n) + 0.1};
            t->bodies.set({state});
            const std::vector<Box> boxes{body_box(s.bodies[0], state, 1.0, n)};
            Fractions fractions(gpu, {n}, s.bodies, 1.0);
            fractions.update(t->bodies, boxes);
            t->term.place(t->bodies, boxes, fractions.level(0));
        }
        return t;
    }
    Field<Faces> upload(const glm::ivec3& n, const std::vector<glm::vec3>& u) {
        Field<Faces> field(gpu, n, Format::RGBA32F);
        field.texture().upload(&pack_vectors(u, field.layout())[0].x);
        return field;
    }
    std::vector<glm::vec3> solve(Tank& t, const Field<Faces>& guess, const Field<Faces>& u, int cycles) {
        const Field<Faces> result = t.term.diffuse(guess, 1e30f, u, 1.0, cycles, t.walls.time(0.0));
        return unpack_vectors(result.texture().download(), result.layout());
    }
    /// Values of f(component, x, y, z) on the faces of the tank; 0 on its walls.
    template <class F>
    static std::vector<glm::vec3> faces(const glm::ivec3& n, F f) {
        std::vector<glm::vec3> u;
        for (int z = 0; z <= n.z; ++z)
            for (int y = 0; y <= n.y; ++y)
                for (int x = 0; x <= n.x; ++x) {
                    const glm::ivec3 c(x, y, z);
                    glm::vec3 value(0.0f);
                    for (int k = 0; k < 3; ++k) {
                        glm::dvec3 place = glm::dvec3(c) + 0.5;
                        place[k] -= 0.5;
                        if (c[k] > 0 && glm::all(glm::lessThan(c, n)))
                            value[k] = static_cast<float>(f(k, place));
                    }
                    u.push_back(value);
                }
        return u;
    }

  private:
    std::unique_ptr<FluidSetup> setup_;
    std::unique_ptr<Walls> walls_;
};

double distance(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
    return std::sqrt(sum);
}

TEST_F(ViscousStep, EachCycleLeavesAQuarterOrLessWhateverTheViscosity) {
    // Measured when the limit was set: 0.09 to 0.21; 0.35 with a body whose coarse image is poor.
    std::mt19937 random(3);
    for (const auto& [n, kind, radius] : {std::tuple(glm::ivec3(16), WallKind::Slip, 0.0),
                                          std::tuple(glm::ivec3(24, 17, 20), WallKind::NoSlip, 0.0),
                                          std::tuple(glm::ivec3(32), WallKind::NoSlip, 6.4),
                                          // The coarsest grids' last cells are next to empty.
                                          std::tuple(glm::ivec3(33), WallKind::NoSlip, 0.0),
                                          std::tuple(glm::ivec3(33, 18, 17), WallKind::Slip, 0.0)})
        for (const double lambda : {0.1, 1.0, 8.0, 100.0, 1000.0, 1e5}) {
            const auto t = tank(n, lambda, kind, radius);
            const auto noise = [&](int, const glm::dvec3& x) {
                const double r = glm::length(x - 0.5 * glm::dvec3(n) - 0.1);
                return r < radius ? 0.0
                                  : static_cast<double>(random()) / static_cast<double>(random.max()) - 0.5;
            };
            const Field<Faces> u = upload(n, faces(n, noise));
            const std::vector<glm::vec3> exact = solve(*t, u, u, 16), one = solve(*t, u, u, 1),
                                         three = solve(*t, u, u, 3);
            EXPECT_LT(distance(three, exact), 0.0625 * distance(one, exact) + 1e-5)
                << n.x << " lambda " << lambda << " radius " << radius;
        }
}

TEST_F(ViscousStep, DampsAnEigenvectorByItsEigenvalue) {
    // u = sin kx cos ky between slip walls: each component is an eigenvector of its own 7-point Laplacian.
    const glm::ivec3 n(20, 20, 12);
    const double k = std::numbers::pi / 20.0;
    const auto mode = faces(n, [&](int c, const glm::dvec3& x) {
        return c == 0   ? std::sin(k * x.x) * std::cos(k * x.y)
               : c == 1 ? -std::cos(k * x.x) * std::sin(k * x.y)
                        : 0.0;
    });
    const double eigenvalue = 4.0 * (1.0 - std::cos(k));
    for (const double lambda : {0.2, 5.0, 300.0}) {
        const auto t = tank(n, lambda, WallKind::Slip, 0.0);
        const Field<Faces> u = upload(n, mode);
        const std::vector<glm::vec3> got = solve(*t, u, u, 10);
        std::vector<glm::vec3> expected = mode;
        for (glm::vec3& v : expected) v *= static_cast<float>(1.0 / (1.0 + lambda * eigenvalue));
        EXPECT_LT(distance(got, expected), 1e-4 * distance(expected, std::vector<glm::vec3>(mode.size())))
            << lambda;
    }
}

TEST_F(ViscousStep, NeverExceedsTheValuesItStartsFrom) {
    // The maximum principle, with a body at rest and walls that hold the fluid.
    const glm::ivec3 n(17, 14, 15);
    for (const double lambda : {0.1, 10.0, 1000.0}) {
        const auto t = tank(n, lambda, WallKind::NoSlip, 3.3);
        const auto start = faces(n, [&](int, const glm::dvec3& x) {
            return glm::length(x - 0.5 * glm::dvec3(n) - 0.1) < 3.3 ? 0.0 : 1.0;
        });
        const Field<Faces> u = upload(n, start);
        for (const glm::vec3& v : solve(*t, u, u, 12))
            for (int k = 0; k < 3; ++k) {
                EXPECT_LE(v[k], 1.0f + 1e-5f);
                EXPECT_GE(v[k], -1e-5f);
            }
    }
}

}  // namespace
}  // namespace eddy::gles
