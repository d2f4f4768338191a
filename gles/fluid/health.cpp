#include "gles/fluid/health.h"

#include "gles/fluid/results.h"

namespace eddy::gles {
namespace {

Variant variant_of(const FluidSetup& setup) {
    Variant v{.layouts = {{"SCALARS", Cells::layout(setup.cells)}}};
    if (setup.smoke) v.defines.emplace_back("SMOKE", "");
    if (setup.temperature && setup.solver.method == Method::CutCell)
        v.defines.emplace_back("TEMPERATURE", "");
    return v;
}

Variant with_flow(Variant v, const FluidSetup& setup, const AtlasLayout& velocity, const AtlasLayout& phi) {
    v.layouts.emplace_back("VELOCITY", velocity);
    v.layouts.emplace_back("PHI", phi);
    v.defines.emplace_back("FLOW", "");
    const bool packed = 4 * phi.size.z >= setup.cells.z && phi.size.z < setup.cells.z;
    v.defines.emplace_back("PHI_LAYERS", packed ? "4" : "1");
    if (setup.viscosity_pa_s > 0.0 && setup.solver.method == Method::CutCell)
        v.defines.emplace_back("DIFFUSED", "");
    return v;
}

}  // namespace

HealthCheck::HealthCheck(Gpu& gpu, const FluidSetup& setup, const AtlasLayout& velocity,
                         const AtlasLayout& phi)
    : HealthCheck(gpu, setup, velocity.size, with_flow(variant_of(setup), setup, velocity, phi)) {}

HealthCheck::HealthCheck(Gpu& gpu, const FluidSetup& setup)
    : HealthCheck(gpu, setup, setup.cells, variant_of(setup)) {}

HealthCheck::HealthCheck(Gpu& gpu, const FluidSetup& setup, const glm::ivec3& texels, Variant variant)
    : gpu_(&gpu),
      to_(Results::health_texel(setup)),
      count_(gpu, "health", "gles/fluid/health.frag", texels, std::move(variant), {Results::width(setup), 1},
             "vec4(0.0, 0.0, 0.0, 1.0)") {}

void HealthCheck::draw(const State& state, const Sound& sound, const Texture& row) {
    Gpu::Stage stage(*gpu_, "health");
    std::vector<Input> inputs;
    if (state.velocity) {
        // Before the first step nothing has been diffused.
        const Texture* diffused = state.diffused ? state.diffused : state.velocity;
        inputs = {{"velocity", state.velocity}, {"phi", state.phi}, {"diffused", diffused}};
    }
    if (state.smoke) inputs.push_back({"smoke", &state.smoke->texture()});
    if (state.temperature) inputs.push_back({"temperature", &state.temperature->texture()});
    count_.draw(inputs,
                {{"fastest", sound.fastest_m_s},
                 {"most_diffused", sound.most_diffused_m_s},
                 {"most_phi", sound.most_phi}},
                row, to_);
}

}  // namespace eddy::gles
