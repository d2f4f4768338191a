#include "gles/body/fractions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gles/fluid/pressure.h"
#include "gles/grid_io.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

/// A ball in a tank of cells of 1 m, so that metres are cells.
class FractionsOfABall : public GlTest {
  protected:
    static constexpr double kRadius = 4.0;
    const glm::ivec3 n{17, 14, 15};
    const std::vector<BodySetup> bodies{{Sphere{kRadius}}};
    BodyUniforms uniforms{gpu, bodies, 1.0};
    Fractions fractions{gpu, multigrid_levels(n), bodies, 1.0};

    void put(const glm::dvec3& centre) {
        BodyState state;
        state.centre_m = centre;
        uniforms.set({state});
        fractions.update(uniforms, {body_box(bodies[0], state, 1.0, n)});
    }

    /// Fractions of the faces of one axis, (nx+1)(ny+1)(nz+1), x fastest.
    static std::vector<float> faces(const Field<Faces4>& field) {
        return unpack_four(field.texture().download(), field.layout(), field.cells() + 1);
    }
    static std::size_t index(const glm::ivec3& cells, const glm::ivec3& c) {
        return static_cast<std::size_t>((c.z * (cells.y + 1) + c.y) * (cells.x + 1) + c.x);
    }
};

/// The share of the unit cube around x that lies outside a ball, by counting 64^3 points.
double counted_fraction(const glm::dvec3& x, const glm::dvec3& centre, double radius) {
    constexpr int kPoints = 64;
    const glm::dvec3 d = x - centre;
    const double reach = std::sqrt(3.0) / 2.0;
    if (glm::length(d) > radius + reach) return 1.0;
    if (glm::length(d) < radius - reach) return 0.0;
    long outside = 0;
    for (int k = 0; k < kPoints; ++k)
        for (int j = 0; j < kPoints; ++j) {
            // Along x, the points inside are a run: count them from the chord.
            const glm::dvec2 yz(d.y + (j + 0.5) / kPoints - 0.5, d.z + (k + 0.5) / kPoints - 0.5);
            const double rest = radius * radius - glm::dot(yz, yz);
            if (rest <= 0.0) {
                outside += kPoints;
                continue;
            }
            for (int i = 0; i < kPoints; ++i)
                outside += std::abs(d.x + (i + 0.5) / kPoints - 0.5) > std::sqrt(rest);
        }
    return static_cast<double>(outside) / (kPoints * kPoints * kPoints);
}

/// What sharpen_fractions.frag does to a row of faces: a, and the shares of the face before and after it.
double sharpened(double before, double a, double after) {
    const auto gain = [a](double there) { return 0.25 * (a - there) * std::min(a, there); };
    return a + gain(before) + gain(after);
}

TEST_F(FractionsOfABall, AreCountedPointsSharpenedAlongTheFacesAxis) {
    const glm::dvec3 centre(8.3, 7.1, 7.45);
    put(centre);
    const Field<Faces4>* axes[] = {&fractions.level(0).x, &fractions.level(0).y, &fractions.level(0).z};
    double worst = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<float> got = faces(*axes[axis]);
        for (int z = 0; z <= n.z; ++z)
            for (int y = 0; y <= n.y; ++y)
                for (int x = 0; x <= n.x; ++x) {
                    glm::dvec3 middle(x + 0.5, y + 0.5, z + 0.5), step(0.0);
                    middle[axis] -= 0.5;
                    step[axis] = 1.0;
                    const auto counted = [&](double along) {
                        return counted_fraction(middle + along * step, centre, kRadius);
                    };
                    const double expected = sharpened(counted(-1.0), counted(0.0), counted(1.0));
                    worst = std::max(worst, std::abs(got[index(n, {x, y, z})] - expected));
                }
    }
    // Where the surface runs along the grid it is smeared out a little (fraction.glsl).
    EXPECT_LT(worst, 0.06);  // measured when the limit was set: 0.037
}

TEST_F(FractionsOfABall, HoldItsVolumeWhereverItIs) {
    const double volume = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;
    double least = 1e9, most = 0.0;
    for (const glm::dvec3 offset :
         {glm::dvec3(0.0), glm::dvec3(0.5), glm::dvec3(0.25, 0.5, 0.0), glm::dvec3(0.1, 0.2, 0.3),
          glm::dvec3(0.9, 0.45, 0.6), glm::dvec3(0.33, 0.77, 0.11)}) {
        put(glm::dvec3(8.0, 7.0, 7.0) + offset);
        for (const Field<Faces4>* axis :
             {&fractions.level(0).x, &fractions.level(0).y, &fractions.level(0).z}) {
            double solid = 0.0;
            for (const float a : faces(*axis)) solid += 1.0 - a;
            EXPECT_NEAR(solid, volume, 0.002 * volume)  // measured 0.0012
                << offset.x << " " << offset.y << " " << offset.z;
            least = std::min(least, solid);
            most = std::max(most, solid);
        }
    }
    // A ball that seems to breathe as it moves pumps fluid: the volume must also hold still.
    EXPECT_LT((most - least) / volume, 0.001);
}

TEST_F(FractionsOfABall, ReturnToOneBehindIt) {
    // Steps larger than the ball, so that the two boxes of a step do not overlap.
    for (const glm::dvec3 centre :
         {glm::dvec3(4.0, 5.0, 5.0), glm::dvec3(13.0, 9.0, 10.0), glm::dvec3(12.5, 5.0, 3.0)})
        put(centre);
    Fractions fresh(gpu, multigrid_levels(n), bodies, 1.0);
    BodyState state;
    state.centre_m = {12.5, 5.0, 3.0};
    fresh.update(uniforms, {body_box(bodies[0], state, 1.0, n)});
    for (std::size_t level = 0; level < multigrid_levels(n).size(); ++level) {
        EXPECT_EQ(faces(fractions.level(level).x), faces(fresh.level(level).x)) << "level " << level;
        EXPECT_EQ(faces(fractions.level(level).y), faces(fresh.level(level).y)) << "level " << level;
        EXPECT_EQ(faces(fractions.level(level).z), faces(fresh.level(level).z)) << "level " << level;
    }
    const std::vector<float> x = faces(fractions.level(0).x);
    EXPECT_EQ(x[index(n, {4, 5, 5})], 1.0f);
    EXPECT_EQ(x[index(n, {12, 5, 3})], 0.0f);
}

TEST_F(FractionsOfABall, OfACoarseFaceAreTheMeanOfItsFourFineOnes) {
    put({8.3, 7.1, 7.45});
    const std::vector<glm::ivec3> grids = multigrid_levels(n);
    for (std::size_t level = 0; level + 1 < grids.size(); ++level) {
        const glm::ivec3 fine_n = grids[level], coarse_n = grids[level + 1];
        const FaceFractions &fine = fractions.level(level), &coarse = fractions.level(level + 1);
        const std::pair<const Field<Faces4>*, const Field<Faces4>*> axes[] = {
            {&fine.x, &coarse.x}, {&fine.y, &coarse.y}, {&fine.z, &coarse.z}};
        for (int axis = 0; axis < 3; ++axis) {
            const std::vector<float> f = faces(*axes[axis].first), c = faces(*axes[axis].second);
            const int across = (axis + 1) % 3, other = (axis + 2) % 3;
            // Faces inside the tank; those of the walls are closed whatever is stored.
            for (int z = 0; z < coarse_n.z; ++z)
                for (int y = 0; y < coarse_n.y; ++y)
                    for (int x = 0; x < coarse_n.x; ++x) {
                        const glm::ivec3 at(x, y, z);
                        if (at[axis] == 0) continue;
                        double mean = 0.0;
                        for (int q = 0; q < 4; ++q) {
                            glm::ivec3 from = 2 * at;
                            from[across] += q & 1;
                            from[other] += q >> 1;
                            // Beyond an odd edge there is no cell, and nothing flows.
                            if (from[across] < fine_n[across] && from[other] < fine_n[other] &&
                                from[axis] < fine_n[axis])
                                mean += 0.25 * f[index(fine_n, from)];
                        }
                        // The floor keeps coarse cells inside a solid in the system (coarsen_fractions.frag).
                        EXPECT_NEAR(c[index(coarse_n, at)], std::max(mean, 1e-3), 1e-6)
                            << "level " << level << " axis " << axis << " at " << x << "," << y << "," << z;
                    }
        }
    }
}

}  // namespace
}  // namespace eddy::gles
