#include <cmath>
#include <limits>

#include "gles/fluid/pressure.h"
#include "gles/fluid/step_guard.h"
#include "gles/fluid/transport.h"
#include "gles/grid_io.h"
#include "tests/gles/gl_fixture.h"
#include "tests/stability/fluid_inside.h"

namespace eddy::gles {
namespace {

// Single passes, with a texel of what they follow that is no number: a place that is none must not be fetched from. In a step as a
// whole (faults_test.cpp) the passes after these would hide it.

struct Carriers : GlTest, testing::WithParamInterface<float> {};

const glm::ivec3 kCells(10, 9, 8), kIll(4, 5, 3);

TEST_P(Carriers, ThatAreNoNumbersCarryNothing) {
    for (const Advection advection : {Advection::SemiLagrangian, Advection::MacCormack}) {
        FluidSetup setup;
        setup.cells = kCells;
        setup.cell_m = 0.1;
        setup.solver.advection = advection;
        setup.solver.time_order = 2;  // then what carries is another field
        const Walls walls(setup);
        VelocityTransport transport(gpu, setup, walls);
        Field<Faces> u(gpu, kCells, Format::RGBA32F), carrier(gpu, kCells, Format::RGBA32F);
        std::vector<glm::vec3> values;
        const glm::ivec3 size = u.layout().size;
        for (int i = 0; i < size.x * size.y * size.z; ++i)
            values.emplace_back(1.0f + 1e-3f * static_cast<float>(i));  // each another
        u.texture().upload(&pack_vectors(values, u.layout())[0].x);
        clear(carrier.texture());
        poison(carrier.texture(), carrier.layout().texel(kIll), GetParam());
        const Field<Faces> carried = transport(u, carrier, 0.1, walls.time(0.0));
        const std::vector<glm::vec3> got = unpack_vectors(carried.texture().download(), carried.layout());
        for (int z = 1; z < size.z - 1; ++z)
            for (int y = 1; y < size.y - 1; ++y)
                for (int x = 1; x < size.x - 1; ++x) {
                    const auto i = static_cast<std::size_t>((z * size.y + y) * size.x + x);
                    ASSERT_EQ(got[i], values[i]) << x << ' ' << y << ' ' << z << ", MacCormack "
                                                 << (advection == Advection::MacCormack);
                }
    }
}

TEST_P(Carriers, OfThePapersMethodCarryNothing) {
    FluidSetup setup;
    setup.cells = kCells;
    setup.cell_m = 0.1;
    Field<Cells> u(gpu, kCells, Format::RGBA32F), smoke(gpu, kCells, Format::R32F);
    const auto texels = static_cast<std::size_t>(u.texture().size().x * u.texture().size().y);
    u.texture().upload(std::vector<float>(4 * texels, 5.0f).data());
    poison(u.texture(), u.layout().texel(kIll), GetParam());
    std::vector<float> each(texels);
    for (std::size_t i = 0; i < texels; ++i) each[i] = 1.0f + 1e-2f * static_cast<float>(i);
    smoke.texture().upload(each.data());
    const auto carried = [&](const char* shader, Format format, const std::vector<Input>& inputs) {
        Field<Cells> out(gpu, kCells, format);
        Pass pass(gpu, "advect", shader, u.layout(), {.defines = {farthest(setup)}});
        pass.draw(inputs, {{"dt_h", 1e-6f}}, {&out.texture()});
        return unpack_texels(out.texture().download(), out.layout());
    };
    const auto at = [](const std::vector<glm::vec4>& all, const glm::ivec3& c) {
        return all[static_cast<std::size_t>((c.z * kCells.y + c.y) * kCells.x + c.x)];
    };
    const Input velocity{"velocity", &u.texture()};
    const std::vector<glm::vec4> of_u = carried("gles/yang2009/advect_velocity.frag", Format::RGBA32F,
                                                {velocity}),
                                 of_smoke = carried("gles/yang2009/advect_smoke.frag", Format::R32F,
                                                    {velocity, {"smoke", &smoke.texture()}});
    EXPECT_EQ(at(of_u, kIll).x, 0.0f) << "nothing is left behind";
    EXPECT_NEAR(at(of_u, kIll + 2).x, 5.0f, 1e-4f);
    const std::vector<glm::vec4> before = unpack_texels(smoke.texture().download(), smoke.layout());
    EXPECT_NEAR(at(of_smoke, kIll).x, at(before, kIll).x, 1e-5f) << "it stays";
}

TEST_P(Carriers, APressureThatFollowsABodyIsANumber) {
    const glm::ivec3 n(16);
    const FluidSetup closed;
    const std::vector<BodySetup> bodies{BodySetup{Sphere{3.0}}};
    Fractions fractions(gpu, multigrid_levels(n), bodies, 1.0);
    Pressure pressure(gpu, n, &fractions, Walls(closed));
    Field<Cells4> phi(gpu, n, Format::RGBA32F);
    const auto texels = static_cast<std::size_t>(phi.texture().size().x * phi.texture().size().y);
    phi.texture().upload(std::vector<float>(4 * texels, 2.0f).data());
    poison(phi.texture(), phi.layout().texel({8, 8, 2}), GetParam());
    const Field<Cells4> moved =
        pressure.follow(std::move(phi), {{glm::vec3(8.5f), glm::vec3(0.5f, 0.0f, 0.0f), 3.0f}});
    EXPECT_EQ(not_finite(moved.texture()), 0);
}

INSTANTIATE_TEST_SUITE_P(Of, Carriers,
                         testing::Values(std::numeric_limits<float>::quiet_NaN(),
                                         std::numeric_limits<float>::infinity(),
                                         -std::numeric_limits<float>::infinity()),
                         [](const auto& test) {
                             return std::isnan(test.param) ? "NotANumber"
                                    : test.param > 0.0f    ? "Infinite"
                                                           : "MinusInfinite";
                         });

}  // namespace
}  // namespace eddy::gles
