#include "gles/gpu.h"

#include <GLES3/gl3.h>

#include "gles/fluid/fluid.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

using GpuTextures = GlTest;

TEST_F(GpuTextures, ThatNobodyHoldsAreFreedWithTheirFramebuffers) {
    gpu.free_idle_textures();
    const std::size_t before = gpu.textures().bytes();
    const TexturePool::Lease held = gpu.textures().lease({16, 8}, Format::RGBA32F);
    const unsigned kept = gpu.framebuffer({held.get()});
    unsigned alone = 0, both = 0, read = 0;
    {
        const TexturePool::Lease idle = gpu.textures().lease({16, 8}, Format::RGBA32F);
        alone = gpu.framebuffer({idle.get()});
        both = gpu.framebuffer({held.get(), idle.get()});
        read = idle.get()->id();
        EXPECT_EQ(gpu.textures().bytes(), before + 2 * 16 * 8 * 16);
    }
    EXPECT_EQ(gpu.textures().bytes(), before + 2 * 16 * 8 * 16) << "it stays, to be lent again";
    gpu.free_idle_textures();
    EXPECT_EQ(gpu.textures().bytes(), before + 16 * 8 * 16);
    EXPECT_FALSE(glIsTexture(read));
    EXPECT_FALSE(glIsFramebuffer(alone));
    EXPECT_FALSE(glIsFramebuffer(both));
    EXPECT_EQ(gpu.framebuffer({held.get()}), kept);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(GpuTextures, FreedInTheMiddleOfARunChangeNothingInIt) {
    FluidSetup setup;
    setup.cells = glm::ivec3(16);
    setup.cell_m = 0.01;
    setup.bodies = {BodySetup{Sphere{0.03}}};
    const std::unique_ptr<Fluid> one = make_fluid(gpu, setup), other = make_fluid(gpu, setup);
    BodyState ball{.centre_m = {0.07, 0.08, 0.09}, .velocity_m_s = {0.1, 0.0, 0.0}};
    for (int i = 0; i < 6; ++i) {
        ball.centre_m.x += 0.02 * ball.velocity_m_s.x;
        std::vector<glm::dvec3> forces;
        for (const auto& fluid : {one.get(), other.get()}) {
            if (fluid == one.get()) gpu.free_idle_textures();
            fluid->step(0.02, {ball}, true);
            forces.push_back(fluid->wait_result().loads.at(0).force_n);
        }
        EXPECT_EQ(forces[0], forces[1]) << "step " << i;
    }
    EXPECT_EQ(one->velocity(), other->velocity());
}

}  // namespace
}  // namespace eddy::gles
