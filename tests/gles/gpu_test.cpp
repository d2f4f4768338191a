#include "gles/gpu.h"

#include <GLES3/gl3.h>

#include "gles/fluid/fluid.h"
#include "gles/pass.h"
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

/// A pass that no other test draws with: `n` tells its program from others.
Pass coloured(Gpu& gpu, int n) {
    return {gpu, "coloured", "gles/render/text.frag", AtlasLayout{glm::ivec3(8 + n, 8, 1), 1}};
}

class GpuPauses : public GlTest {
  protected:
    ~GpuPauses() override { gpu.on_pause({}); }
};

TEST_F(GpuPauses, ComeBeforeEachProgramAndEachFirstDrawButNotInTheirOwnWork) {
    int pauses = 0, compiles = 0;
    gpu.on_pause([&](Next next) {
        ++pauses;
        compiles += next == Next::Compiling;
        coloured(gpu, pauses);
    });
    const std::size_t linked = gpu.programs().linked();
    Pass pass = coloured(gpu, 100);
    EXPECT_EQ(pauses, 1);
    EXPECT_EQ(gpu.programs().linked(), linked + 2);
    const TexturePool::Lease page = gpu.textures().lease({8, 8}, Format::RGBA8);
    const TexturePool::Lease picture = gpu.textures().lease({108, 8}, Format::RGBA8);
    for (int n = 0; n < 3; ++n) pass.draw({{"page", &*page}}, {{"corner", glm::vec2(0.0f)}}, {&*picture});
    EXPECT_EQ(pauses, 2) << "drivers compile at the first draw, too";
    EXPECT_EQ(compiles, 2);
    { const Gpu::Stage stage(gpu, "a stage"); }
    EXPECT_EQ(pauses, 3);
    EXPECT_EQ(compiles, 2);
    gpu.on_pause({});
    { const Gpu::Stage stage(gpu, "a stage"); }
    EXPECT_EQ(pauses, 3);
}

TEST_F(GpuPauses, LetTheWorkBeGivenUp) {
    gpu.on_pause([](Next) { throw 1; });
    const std::size_t linked = gpu.programs().linked();
    EXPECT_THROW(coloured(gpu, 200), int);
    EXPECT_EQ(gpu.programs().linked(), linked);
    gpu.on_pause({});
    coloured(gpu, 200);
    EXPECT_EQ(gpu.programs().linked(), linked + 1);
}

}  // namespace
}  // namespace eddy::gles
