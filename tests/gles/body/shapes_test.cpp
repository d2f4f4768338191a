#include "gles/body/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "gles/body/distance_grid.h"
#include "tests/gles/body/sample_meshes.h"
#include "tests/gles/body/shape_reference.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

/// Asks the shaders of some bodies about points. Cells are 1 m, so that metres are cells.
class Probe {
  public:
    /// `answer`: a vec4 at x.
    Probe(Gpu& gpu, const std::vector<BodySetup>& bodies, const char* answer)
        : gpu_(gpu),
          uniforms_(gpu, bodies, 1.0),
          // The pass that copies texels, with each texel asked on the way.
          pass_(gpu, "ask", "gles/copy.frag", {{kWidth, 1, 1}, 1},
                {.declarations = shape_declarations(bodies) +
                                 fmt::format("vec4 ask(vec3 x) {{ return {}; }}\n"
                                             "#define texelFetch(f, t, l) ask(texelFetch(f, t, l).xyz)\n",
                                             answer)}) {}

    std::vector<glm::vec4> operator()(const std::vector<BodyState>& states,
                                      const std::vector<glm::dvec3>& points) {
        const glm::ivec2 size(kWidth, (static_cast<int>(points.size()) + kWidth - 1) / kWidth);
        std::vector<glm::vec4> texels(static_cast<std::size_t>(size.x * size.y), glm::vec4(0.0f));
        for (std::size_t i = 0; i < points.size(); ++i) texels[i] = glm::vec4(glm::vec3(points[i]), 0.0f);
        const TexturePool::Lease in = gpu_.textures().lease(size, Format::RGBA32F),
                                 out = gpu_.textures().lease(size, Format::RGBA32F);
        in.get()->upload(&texels[0].x);
        uniforms_.set(states);
        std::vector<Input> inputs = uniforms_.inputs();
        inputs.push_back({"field", in.get()});
        pass_.draw(inputs, uniforms_.uniforms(), {out.get()});
        texels = out.get()->download();
        texels.resize(points.size());
        return texels;
    }

  private:
    static constexpr int kWidth = 64;
    Gpu& gpu_;
    BodyUniforms uniforms_;
    Pass pass_;
};

/// The distance to one body in poses of its choice.
class DistanceProbe {
  public:
    DistanceProbe(Gpu& gpu, const BodySetup& body) : probe_(gpu, {body}, "vec4(solid_distance(x))") {}
    std::vector<double> operator()(const BodyState& state, const std::vector<glm::dvec3>& points) {
        std::vector<double> distances;
        for (const glm::vec4& answer : probe_({state}, points))
            distances.push_back(static_cast<double>(answer.x));
        return distances;
    }

  private:
    Probe probe_;
};

class Shapes : public GlTest {
  protected:
    Random random{1};

    BodyState random_state(double low, double high) {
        BodyState state;
        state.centre_m = random_point(random, low, high);
        state.orientation = random_turn(random) * 1.01;  // as an integrator may leave it
        state.velocity_m_s = random_point(random, -1.0, 1.0);
        state.spin_rad_s = random_point(random, -1.0, 1.0);
        return state;
    }
    std::vector<glm::dvec3> random_points(int count, double low, double high) {
        std::vector<glm::dvec3> points;
        for (int i = 0; i < count; ++i) points.push_back(random_point(random, low, high));
        return points;
    }
};

glm::dvec3 in_body(const BodyState& state, const glm::dvec3& x) {
    return glm::inverse(glm::normalize(state.orientation)) * (x - state.centre_m);
}

// 32-bit floats at coordinates below 32: 1e-5. The reference cuts arcs into chords: 1e-6.
constexpr double kRounding = 3e-5;

TEST_F(Shapes, LieWhereTheyShouldInEveryPose) {
    for (const auto& [name, shape] : closed_form_shapes()) {
        if (name == "ellipsoid") continue;
        DistanceProbe ask(gpu, {shape});
        for (int pose = 0; pose < 3; ++pose) {
            const BodyState state = random_state(12.0, 16.0);
            const std::vector<glm::dvec3> points = random_points(250, 5.0, 23.0);
            const std::vector<double> found = ask(state, points);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const double expected = exact_distance(shape, in_body(state, points[i]));
                // Of a paddle's inside only the side and a lower bound are promised.
                if (name == "paddle" && expected < 0.0) {
                    EXPECT_LT(found[i], 0.0) << name;
                } else {
                    ASSERT_NEAR(found[i], expected, kRounding) << name << " point " << i;
                }
            }
        }
    }
}

TEST_F(Shapes, EllipsoidsAreOffByTheSquareOfTheDistanceAndNeverTooFar) {
    const Ellipsoid ellipsoid{{4.5, 2.5, 3.5}};
    DistanceProbe ask(gpu, {ellipsoid});
    double worst = 0.0;
    for (int pose = 0; pose < 3; ++pose) {
        const BodyState state = random_state(12.0, 16.0);
        const std::vector<glm::dvec3> points = random_points(1000, 6.0, 22.0);
        const std::vector<double> found = ask(state, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double expected = exact_distance(ellipsoid, in_body(state, points[i]));
            EXPECT_EQ(found[i] < 0.0, expected < 0.0);
            if (expected > 0.0) {
                EXPECT_LT(found[i], expected + kRounding);
            }
            if (std::abs(expected) > 0.05 && std::abs(expected) < 1.0)
                worst = std::max(worst, std::abs(found[i] - expected) / (expected * expected));
        }
    }
    EXPECT_LT(worst, 0.1);  // measured 0.067; half the sharpest curvature is 0.36
}

TEST_F(Shapes, DistancesGrowByOneCellPerCellNearTheSurface) {
    constexpr double kStep = 0.05;
    for (const auto& [name, shape] : closed_form_shapes()) {
        const BodyState state = random_state(12.0, 16.0);
        const std::vector<glm::dvec3> middles = random_points(2000, 6.0, 22.0);
        std::vector<glm::dvec3> points = middles;
        for (const glm::dvec3& x : middles)
            for (int axis = 0; axis < 3; ++axis)
                for (const double side : {kStep, -kStep}) {
                    points.push_back(x);
                    points.back()[axis] += side;
                }
        const std::vector<double> found = DistanceProbe(gpu, {shape})(state, points);
        int near = 0, kinks = 0;
        double worst = 0.0;
        for (std::size_t i = 0; i < middles.size(); ++i) {
            // Nearer to an edge than this, its curvature shows within a step.
            if (found[i] < 0.3 || found[i] > 1.0) continue;
            glm::dvec3 gradient;
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t pair = middles.size() + 6 * i + 2 * static_cast<std::size_t>(axis);
                gradient[axis] = (found[pair] - found[pair + 1]) / (2.0 * kStep);
            }
            const double off = std::abs(glm::length(gradient) - 1.0);
            ++near;
            kinks += off > 0.02;
            worst = std::max(worst, off);
        }
        ASSERT_GT(near, 50) << name;
        if (name == "paddle") {
            // In the corner between its blade and its handle two distances meet.
            EXPECT_LT(kinks, near / 20) << name;
        } else {
            EXPECT_LT(worst, name == "ellipsoid" ? 0.1 : 0.005) << name;
        }
    }
}

TEST_F(Shapes, OfAMeshAreThoseOfItsGridInsideAndOutsideOfIt) {
    const Mesh ball{std::make_shared<DistanceGrid>(icosphere(4.0, 3, {1.0, 0.5, -0.3}), 40)};
    const BodyState state = random_state(12.0, 16.0);
    const std::vector<glm::dvec3> points = random_points(2000, 2.0, 26.0);
    const bool can_filter = gpu.filters_float();
    for (const bool filters : {true, false}) {
        gpu.set_filters_float(filters);
        // Filters of a driver may weigh texels in steps of 1/256.
        const double tolerance = filters ? ball.distance->spacing_m() / 256.0 : kRounding;
        const std::vector<double> found = DistanceProbe(gpu, {ball})(state, points);
        for (std::size_t i = 0; i < points.size(); ++i)
            ASSERT_NEAR(found[i], ball.distance->at(in_body(state, points[i])), tolerance);
    }
    gpu.set_filters_float(can_filter);
}

TEST_F(Shapes, TurnedInsideOutAreSolidOutside) {
    for (const Shape& shape :
         {Shape(Sphere{3.0}), Shape(Ellipsoid{{4.5, 2.5, 3.5}}), Shape(Paddle{{5.0, 5.0, 1.8}, 1.2, 3.0})}) {
        const BodyState state = random_state(12.0, 16.0);
        const std::vector<glm::dvec3> points = random_points(200, 6.0, 22.0);
        const std::vector<double> solid = DistanceProbe(gpu, {shape})(state, points);
        const std::vector<double> hollow =
            DistanceProbe(gpu, {.shape = shape, .inside_out = true})(state, points);
        for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(hollow[i], -solid[i]) << shape.index();
    }
}

TEST_F(Shapes, OfSeveralBodiesTheNearestCountsAndMoves) {
    std::vector<BodySetup> bodies;
    std::vector<BodyState> states;
    for (const Shape& shape : {Shape(Sphere{3.0}), Shape(Cuboid{{4.0, 7.0, 2.5}}),
                               Shape(Paddle{{5.0, 5.0, 1.8}, 1.2, 3.0}), Shape(Tetrahedron{7.0})})
        bodies.push_back({shape});
    const auto grid = std::make_shared<DistanceGrid>(box_mesh({-2.0, -1.0, -3.0}, {3.0, 1.0, 2.0}), 24);
    bodies.push_back({Mesh{grid}});
    bodies.push_back({Mesh{grid}});
    bodies.push_back({Mesh{std::make_shared<DistanceGrid>(icosphere(2.0, 2), 24)}});
    bodies.push_back({.shape = Sphere{30.0}, .inside_out = true});
    for (std::size_t b = 0; b < bodies.size(); ++b) states.push_back(random_state(4.0, 44.0));
    states.back().centre_m = glm::dvec3(24.0);

    const std::vector<glm::dvec3> points = random_points(500, 0.0, 48.0);
    const std::vector<glm::vec4> all = Probe(gpu, bodies, "vec4(solid_distance(x))")(states, points);
    const std::vector<glm::vec4> nearest =
        Probe(gpu, bodies, "vec4(solid_velocity(x), float(nearest_body(x)))")(states, points);
    std::vector<std::vector<double>> alone;
    for (std::size_t b = 0; b < bodies.size(); ++b)
        alone.push_back(DistanceProbe(gpu, bodies[b])(states[b], points));
    std::vector<int> met(bodies.size(), 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        double least = 1e9;
        for (const std::vector<double>& distances : alone) least = std::min(least, distances[i]);
        ASSERT_NEAR(static_cast<double>(all[i].x), least, kRounding);
        const auto b = static_cast<std::size_t>(nearest[i].w);
        ASSERT_NEAR(alone[b][i], least, kRounding);
        const glm::dvec3 velocity =
            states[b].velocity_m_s + glm::cross(states[b].spin_rad_s, points[i] - states[b].centre_m);
        ASSERT_LT(glm::length(glm::dvec3(nearest[i]) - velocity), 1e-4);
        ++met[b];
    }
    for (std::size_t b = 0; b < bodies.size(); ++b) EXPECT_GT(met[b], 0) << "body " << b;
    // Two bodies of one mesh share its texture.
    EXPECT_EQ(BodyUniforms(gpu, bodies, 1.0).inputs().size(), 2u);
}

TEST_F(Shapes, AreOnlyInTheShadersOfScenesThatHaveThem) {
    const std::string sphere = shape_declarations({{Sphere{}}});
    EXPECT_EQ(sphere.find("axes"), std::string::npos) << "a sphere need not be turned";
    std::vector<NamedShape> shapes = closed_form_shapes();
    shapes.push_back({"mesh", Mesh{std::make_shared<DistanceGrid>(icosphere(2.0, 1), 8)}});
    for (const auto& [name, shape] : shapes) {
        const std::string text = shape_declarations({{shape}});
        for (const auto& [other, another] : shapes) {
            if (another.index() == shape.index()) continue;
            const bool is_part = name == "paddle" && (other == "cuboid" || other == "cylinder");
            if (!is_part) {
                EXPECT_EQ(text.find(other + "_distance"), std::string::npos) << name << " brings " << other;
            }
        }
    }
    EXPECT_EQ(shape_declarations({}), "");
}

}  // namespace
}  // namespace eddy::gles
