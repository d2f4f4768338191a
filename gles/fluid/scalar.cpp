#include "gles/fluid/scalar.h"

#include <string>

#include "gles/grid_io.h"

namespace eddy::gles {

std::optional<ScalarSetup> Scalar::smoke(const FluidSetup& setup) {
    if (!setup.smoke) return std::nullopt;
    return ScalarSetup{.name = "smoke",
                       .at_start = setup.smoke->at_start,
                       .from_source = &SourceSetup::smoke_per_s,
                       .fading_1_s = setup.smoke->dissipation_1_s};
}

std::optional<ScalarSetup> Scalar::temperature(const FluidSetup& setup) {
    if (!setup.temperature) return std::nullopt;
    return ScalarSetup{.name = "heat",
                       .at_start = setup.temperature->at_start_k,
                       .from_source = &SourceSetup::temperature_k_per_s,
                       .diffusivity_m2_s = setup.temperature->diffusivity_m2_s};
}

Scalar::Scalar(Gpu& gpu, const FluidSetup& setup, const ScalarSetup& scalar, const Walls& walls,
               const Fractions* fractions)
    : gpu_(&gpu),
      cell_m_(setup.cell_m),
      setup_(scalar),
      field_(gpu, setup.cells, Format::R32F),
      transport_(gpu, setup, scalar, walls) {
    if (scalar.diffusivity_m2_s > 0.0) diffusion_.emplace(gpu, setup, scalar.diffusivity_m2_s, fractions);
    reset();
}

void Scalar::reset() {
    const glm::ivec3 n = field_.cells();
    std::vector<float> values;
    for (int z = 0; z < n.z; ++z)
        for (int y = 0; y < n.y; ++y)
            for (int x = 0; x < n.x; ++x)
                values.push_back(setup_.at_start ? static_cast<float>(
                                                       setup_.at_start(cell_m_ * (glm::dvec3(x, y, z) + 0.5)))
                                                 : 0.0f);
    field_.texture().upload(pack_scalars(values, field_.layout()).data());
}

void Scalar::take_over(const Field<Cells>* from, Resample& resample) {
    if (from)
        field_ = resample.in_cells(*from);
    else
        reset();
}

void Scalar::step(const Field<Faces>& u, double time_s, double dt_s, const Uniform& wall_time) {
    const std::string name = setup_.name;
    {
        Gpu::Stage stage(*gpu_, "advect " + name);
        field_ = transport_(field_, u, time_s, dt_s, wall_time);  // s = s(x - dt u) + dt q
    }
    if (diffusion_) {
        Gpu::Stage stage(*gpu_, "diffuse " + name);
        field_ = (*diffusion_)(field_, dt_s);  // s - kappa dt lap s = s*
    }
}

}  // namespace eddy::gles
