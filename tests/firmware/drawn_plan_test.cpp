#include <GLES3/gl3.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "config/scene.h"
#include "firmware/body_schedule.h"
#include "firmware/fluid_setup.h"
#include "gles/body/fractions.h"
#include "gles/fluid/fluid.h"
#include "tests/gles/gl_fixture.h"

// What GL was really asked to do, counted on the way in: this program defines the functions that draw, that make
// textures and that set uniforms, and hands each call on to the driver.

namespace {

struct Asked {
    long draws = 0, textures = 0, uniforms = 0;
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

// Every glUniform call that gles/pass.cpp makes; one that it does not name would not be counted.
#define COUNTED_UNIFORM(name, parameters, arguments)             \
    void name parameters {                                       \
        static auto* const driver = next<decltype(name)>(#name); \
        ++g_asked.uniforms;                                      \
        driver arguments;                                        \
    }
COUNTED_UNIFORM(glUniform1i, (GLint at, GLint x), (at, x))
COUNTED_UNIFORM(glUniform1f, (GLint at, GLfloat x), (at, x))
COUNTED_UNIFORM(glUniform2f, (GLint at, GLfloat x, GLfloat y), (at, x, y))
COUNTED_UNIFORM(glUniform3f, (GLint at, GLfloat x, GLfloat y, GLfloat z), (at, x, y, z))
COUNTED_UNIFORM(glUniform4f, (GLint at, GLfloat x, GLfloat y, GLfloat z, GLfloat w), (at, x, y, z, w))
COUNTED_UNIFORM(glUniform3i, (GLint at, GLint x, GLint y, GLint z), (at, x, y, z))
COUNTED_UNIFORM(glUniform4i, (GLint at, GLint x, GLint y, GLint z, GLint w), (at, x, y, z, w))
COUNTED_UNIFORM(glUniform3fv, (GLint at, GLsizei n, const GLfloat* v), (at, n, v))
COUNTED_UNIFORM(glUniform4fv, (GLint at, GLsizei n, const GLfloat* v), (at, n, v))
COUNTED_UNIFORM(glUniformMatrix3fv, (GLint at, GLsizei n, GLboolean turned, const GLfloat* v),
                (at, n, turned, v))
COUNTED_UNIFORM(glUniformMatrix4fv, (GLint at, GLsizei n, GLboolean turned, const GLfloat* v),
                (at, n, turned, v))
#undef COUNTED_UNIFORM
}

namespace eddy {
namespace {

/// A shipped scene on a grid whose shortest side has 16 cells, with one of the presets.
Scene small_scene(std::string_view name, const std::string& preset) {
    const glm::ivec3 n = load_scene(std::string(name)).scene.tank.cells;
    const glm::ivec3 small = n * 16 / std::min({n.x, n.y, n.z});
    const std::vector<std::string> overrides{fmt::format("tank.cells=[{},{},{}]", small.x, small.y, small.z),
                                             fmt::format("solver.preset=\"{}\"", preset)};
    return load_scene(std::string(name), overrides).scene;
}

/// A validation scene as it is, but on a coarser grid if it has more than 32^3 cells.
Scene small_validation_scene(const std::string& name) {
    glm::ivec3 n = load_scene(name).scene.tank.cells;
    while (n.x * n.y * n.z > 32 * 32 * 32) n /= 2;
    const std::vector<std::string> overrides{fmt::format("tank.cells=[{},{},{}]", n.x, n.y, n.z)};
    return load_scene(name, overrides).scene;
}

/// Uniforms that say where a draw draws.
constexpr int kPlaces = 2;

/// What of a scene calls for a pass whose name starts so. The longest start counts.
struct Caller {
    const char* start;
    bool (*calls)(const Scene&);
};
bool any_body(const Scene& s) {
    return !s.bodies.empty();
}
bool any_measured(const Scene& s) {
    return std::any_of(s.bodies.begin(), s.bodies.end(),
                       [](const Scene::Body& b) { return b.force || b.torque; });
}
bool any_coupled(const Scene& s) {
    return std::any_of(s.bodies.begin(), s.bodies.end(),
                       [](const Scene::Body& b) { return b.motion == BodyMotion::Free || b.turning; });
}
template <class Member>
bool any_source(const Scene& s, Member what) {
    return std::any_of(s.sources.begin(), s.sources.end(),
                       [&](const Scene::Source& source) { return (source.*what).has_value(); });
}
bool corrects(const Scene& s) {
    return s.solver.advection ? s.solver.advection == AdvectionScheme::MacCormack
                              : s.solver.preset == SolverPreset::Precise;
}
bool thin(const Scene& s) {
    const gles::FluidSetup setup = fluid_setup(s);
    return gles::any_thin_body(setup.bodies, setup.cell_m);
}
bool always(const Scene&) {
    return true;
}
bool solved(const Scene& s) {
    return !s.imposed;
}
bool viscous(const Scene& s) {
    return s.fluid.viscosity_pa_s > 0.0;
}
bool smoky(const Scene& s) {
    return s.smoke.has_value();
}
bool warm(const Scene& s) {
    return s.temperature.has_value();
}
bool spreading(const Scene& s) {
    return warm(s) && s.temperature->diffusivity_m2_s > 0.0;
}
bool second_order(const Scene& s) {
    return s.solver.time_order == 2;
}
bool makes_energy(const Scene& s) {
    const auto walls = s.tank.walls.all();
    const bool still = std::all_of(walls.begin(), walls.end(), [](const Scene::Wall* wall) {
        return wall->kind != WallKind::Inflow && !wall->velocity_m_s;
    });
    return solved(s) && still && (corrects(s) || second_order(s));
}
bool pushed(const Scene& s) {
    return s.fluid.gravity_m_s2 != glm::dvec3(0.0) || s.forcing;
}

const Caller kCallers[] = {
    {"add halves", second_order},
    {"add loads", [](const Scene& s) { return second_order(s) && any_measured(s); }},
    {"add potentials", any_coupled},
    {"add pressure", viscous},
    {"advect heat", warm},
    {"advect smoke", smoky},
    {"advect velocity", solved},
    {"body forces", pushed},
    {"coarsen fractions", any_body},
    {"confine", [](const Scene& s) { return s.vorticity_confinement.has_value(); }},
    {"copy back", any_body},
    {"correct heat", [](const Scene& s) { return warm(s) && corrects(s); }},
    {"correct smoke", [](const Scene& s) { return smoky(s) && corrects(s); }},
    {"correct velocity", [](const Scene& s) { return solved(s) && corrects(s); }},
    {"diagnose", always},
    {"diffusion", spreading},
    {"distances", [](const Scene& s) { return viscous(s) && any_body(s); }},
    {"divergence", always},
    {"divergence cut", any_body},
    {"drive sources", [](const Scene& s) { return any_source(s, &Scene::Source::velocity_m_s); }},
    {"flux of unit velocity", any_coupled},
    {"follow bodies", any_body},
    {"force", any_measured},
    {"fractions", any_body},
    {"grip", [](const Scene& s) { return viscous(s) && any_body(s); }},
    {"health", always},
    {"heat sources", [](const Scene& s) { return any_source(s, &Scene::Source::temperature_k_per_s); }},
    {"imposed flow", [](const Scene& s) { return s.imposed.has_value(); }},
    {"jacobi", solved},
    {"keep energy", makes_energy},
    {"keep pressure", thin},
    {"least residual", thin},
    {"owners", [](const Scene& s) { return s.outputs.force_methods; }},
    {"pressure level", any_body},
    {"project", solved},
    {"project cut", any_body},
    {"prolong", solved},
    {"reduce diagnosis", always},
    {"reduce health", always},
    {"reduce heat", warm},
    {"reduce pressure level", any_body},
    {"reduce products", thin},
    {"reduce transport energy", makes_energy},
    {"put pressure right", any_body},
    {"reflect", second_order},
    {"residual", thin},
    {"restrict residual", solved},
    {"sharpen fractions", any_body},
    {"smoke sources", [](const Scene& s) { return any_source(s, &Scene::Source::smoke_per_s); }},
    {"smooth", solved},
    {"solve", solved},
    {"sum force", any_measured},
    {"sum traction", [](const Scene& s) { return any_measured(s) || any_coupled(s); }},
    {"traction", [](const Scene& s) { return any_measured(s) || any_coupled(s); }},
    {"transport energy", makes_energy},
    {"viscosity", viscous},
    {"viscous", viscous},
    {"voxelise", any_body},
    {"vorticity", [](const Scene& s) { return s.vorticity_confinement.has_value(); }},
};

void expect_called_for(const gles::PassRecord& record, const Scene& scene) {
    const Caller* longest = nullptr;
    for (const Caller& caller : kCallers)
        if (record.pass.starts_with(caller.start) &&
            (!longest || std::string_view(caller.start).size() > std::string_view(longest->start).size()))
            longest = &caller;
    ASSERT_NE(longest, nullptr) << "which part of a scene calls for the pass " << record.pass << "?";
    EXPECT_TRUE(longest->calls(scene)) << record.pass << " in a scene that does not call for it";
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
        Asked planned;
        for (const gles::PassRecord& r : records) {
            planned.draws += r.draws;
            planned.uniforms += static_cast<long>(r.uniforms.size()) + kPlaces * r.draws;
            EXPECT_FALSE(r.stage.empty()) << r.pass << " belongs to no stage";
            expect_called_for(r, scene);
        }
        EXPECT_EQ(g_asked.draws - before.draws, planned.draws) << "step " << n;
        // Passes that are drawn for the first time are linked: their samplers are numbered, once.
        if (n > 2) {
            EXPECT_EQ(g_asked.uniforms - before.uniforms, planned.uniforms) << "step " << n;
        }
        EXPECT_GT(planned.draws, 0);
        EXPECT_TRUE(n <= 2 || g_asked.textures == before.textures) << "step " << n << " made textures";
    }
    EXPECT_EQ(g_asked.textures, static_cast<long>(own.textures().made()));
    EXPECT_EQ(g_asked.bytes, own.textures().bytes());
}

/// A shipped scene with a preset, or a validation scene as it is (preset "").
class DrawnPlan : public gles::GlTest,
                  public testing::WithParamInterface<std::tuple<std::string_view, std::string>> {};

TEST_P(DrawnPlan, IsWhatGlWasAskedToDo) {
    const auto& [name, preset] = GetParam();
    if (preset == "yang2009" && load_scene(std::string(name)).scene.fluid.gravity_m_s2 != glm::dvec3(0.0))
        GTEST_SKIP() << "skipped: the method of 2009 has no gravity";
    expect_plan_is_what_gl_does(gpu.capabilities(), preset.empty() ? small_validation_scene(std::string(name))
                                                                   : small_scene(name, preset));
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
    std::string name = std::string(std::get<0>(info.param)) + "_" + std::get<1>(info.param);
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(ShippedScene, DrawnPlan,
                         testing::Combine(testing::ValuesIn(shipped_scenes()),
                                          testing::Values("fast", "precise", "yang2009")),
                         test_name);
INSTANTIATE_TEST_SUITE_P(ValidationScene, DrawnPlan,
                         testing::Combine(testing::ValuesIn(validation_scenes()), testing::Values("")),
                         test_name);

}  // namespace
}  // namespace eddy
