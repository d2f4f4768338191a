#include <GLES3/gl3.h>
#include <dlfcn.h>

#include <algorithm>
#include <numeric>

#include "config/scene.h"
#include "firmware/body_schedule.h"
#include "firmware/fluid_setup.h"
#include "gles/fluid/fluid.h"
#include "tests/gles/gl_fixture.h"

// What GL was really asked to do, counted on the way in: this program defines the functions that draw and
// that make textures, and hands each call on to the driver.

namespace {

struct Asked {
    long draws = 0, textures = 0;
    std::size_t bytes = 0;
} g_asked;

template <class F>
F* next(const char* name) {
    return reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

std::size_t bytes_per_texel(GLenum format) {
    switch (format) {
        case GL_R16F:
            return 2;
        case GL_RGBA8:
        case GL_R32F:
            return 4;
        case GL_RG32F:
        case GL_RGBA16F:
            return 8;
        case GL_RGBA32F:
            return 16;
        default:
            ADD_FAILURE() << "texture format " << format << " is new to this test";
            return 0;
    }
}

}  // namespace

extern "C" {

void glDrawArrays(GLenum mode, GLint first, GLsizei count) {
    static auto* const driver = next<decltype(glDrawArrays)>("glDrawArrays");
    ++g_asked.draws;
    driver(mode, first, count);
}

void glDrawArraysInstanced(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
    static auto* const driver = next<decltype(glDrawArraysInstanced)>("glDrawArraysInstanced");
    ++g_asked.draws;
    driver(mode, first, count, instances);
}

void glTexStorage2D(GLenum target, GLsizei levels, GLenum format, GLsizei width, GLsizei height) {
    static auto* const driver = next<decltype(glTexStorage2D)>("glTexStorage2D");
    ++g_asked.textures;
    g_asked.bytes +=
        bytes_per_texel(format) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    driver(target, levels, format, width, height);
}
}

namespace eddy {
namespace {

/// A shipped scene on a grid whose shortest side has 16 cells, with one of the presets.
Scene small_scene(std::string_view name, const std::string& preset) {
    const glm::ivec3 n = load_scene(std::string(name)).scene.tank.cells;
    const glm::ivec3 small = n * 16 / std::min({n.x, n.y, n.z});
    const std::vector<std::string> overrides{"tank.cells=[" + std::to_string(small.x) + "," +
                                                 std::to_string(small.y) + "," + std::to_string(small.z) +
                                                 "]",
                                             "solver.preset=\"" + preset + "\""};
    return load_scene(std::string(name), overrides).scene;
}

/// Runs a scene for six steps and compares their plan with what GL was asked to do.
void expect_plan_is_what_gl_does(const gles::Capabilities& capabilities, const Scene& scene) {
    const BodySchedule motions(scene);
    gles::Gpu own(capabilities);
    g_asked = {};
    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(own, fluid_setup(scene));
    const double dt = scene.solver.dt_s;
    for (int n = 1; n <= 6; ++n) {
        const bool diagnose = n == 2 || n == 6;
        const Asked before = g_asked;
        std::vector<gles::PassRecord> records;
        own.record(&records);
        fluid->step(dt, motions.at(n * dt, dt), diagnose);
        own.record(nullptr);
        fluid->result(true);
        const long planned =
            std::accumulate(records.begin(), records.end(), 0L,
                            [](long sum, const gles::PassRecord& r) { return sum + r.draws; });
        EXPECT_EQ(g_asked.draws - before.draws, planned) << "step " << n;
        EXPECT_GT(planned, 0);
        for (const gles::PassRecord& r : records)
            EXPECT_FALSE(r.stage.empty()) << r.pass << " belongs to no stage";
        EXPECT_TRUE(n <= 2 || g_asked.textures == before.textures) << "step " << n << " made textures";
    }
    EXPECT_EQ(g_asked.textures, static_cast<long>(own.textures().made()));
    EXPECT_EQ(g_asked.bytes, own.textures().bytes());
}

class DrawnPlan : public gles::GlTest,
                  public testing::WithParamInterface<std::tuple<std::string_view, std::string>> {};

TEST_P(DrawnPlan, IsWhatGlWasAskedToDo) {
    const auto& [name, preset] = GetParam();
    if (preset == "yang2009" && load_scene(std::string(name)).scene.fluid.gravity_m_s2 != glm::dvec3(0.0))
        GTEST_SKIP() << "skipped: the method of 2009 has no gravity";
    expect_plan_is_what_gl_does(gpu.capabilities(), small_scene(name, preset));
}

/// What no shipped scene has.
const std::pair<std::string_view, std::string_view> kEffects[] = {
    {"heat",
     "[tank]\ncells = [16, 16, 16]\n[fluid]\ngravity_m_s2 = [0, -9.81, 0]\n"
     "[temperature]\nexpansion_1_k = 0.0034\ndiffusivity_m2_s = 0.01\ninitial_k = \"100 * y\"\n"
     "[[source]]\ncentre_m = [0.08, 0.03, 0.08]\nradius_m = 0.02\ntemperature_k_per_s = 40\n"
     "[[body]]\nradius_m = 0.02\ncentre_m = [0.08, 0.08, 0.08]\n"},
    {"second_order",
     "[tank]\ncells = [16, 16, 16]\n[fluid]\ngravity_m_s2 = [0, -9.81, 0]\n[smoke]\nweight = 1\n"
     "[[body]]\nradius_m = 0.02\ncentre_m = [0.08, 0.08, 0.08]\nmotion = \"prescribed\"\n"
     "velocity_m_s = [0.1, 0, 0]\n[solver]\npreset = \"precise\"\ntime_order = 2\n"},
    {"imposed_steady",
     "[tank]\ncells = [16, 16, 16]\n[smoke]\n[imposed]\nvelocity_m_s = [\"-y\", \"x\", 0]\n"},
    {"imposed_waving",
     "[tank]\ncells = [16, 16, 16]\n[smoke]\n[temperature]\ndiffusivity_m2_s = 1e-4\n"
     "[imposed]\nvelocity_m_s = [\"cos(t)\", 0, 0]\n"},
};

class DrawnEffect : public gles::GlTest,
                    public testing::WithParamInterface<std::pair<std::string_view, std::string_view>> {};

TEST_P(DrawnEffect, IsWhatGlWasAskedToDo) {
    expect_plan_is_what_gl_does(gpu.capabilities(), read_scene(GetParam().second, "effect.toml").scene);
}

INSTANTIATE_TEST_SUITE_P(Effect, DrawnEffect, testing::ValuesIn(kEffects),
                         [](const auto& tested) { return std::string(tested.param.first); });

std::string test_name(const testing::TestParamInfo<DrawnPlan::ParamType>& info) {
    return std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param);
}

INSTANTIATE_TEST_SUITE_P(ShippedScene, DrawnPlan,
                         testing::Combine(testing::ValuesIn(shipped_scenes()),
                                          testing::Values("fast", "precise", "yang2009")),
                         test_name);

}  // namespace
}  // namespace eddy
