#include "gles/fluid/diffusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gles/fluid/pressure.h"

namespace eddy::gles {
namespace {

constexpr float kLeastLambda = 0.0625f;  // below it a few sweeps leave nothing for a coarser grid to do
constexpr int kMostSweeps = 8;
constexpr double kEnough =
    500.0;                  // error before to error after, of the sweeps where there is no coarser grid
constexpr int kCycles = 3;  // each leaves about a sixth of the error

/// So many that the error falls to 1 / kEnough, by the Chebyshev polynomial's value outside the eigenvalues; a power of 2.
int sweeps_alone(float lambda) {
    const double outside = std::acosh(1.0 + 1.0 / (6.0 * static_cast<double>(lambda)));
    int n = 1;
    while (n < kMostSweeps && std::cosh(n * outside) < kEnough) n *= 2;
    return n;
}

}  // namespace

Diffusion::Diffusion(Gpu& gpu, const FluidSetup& setup, double diffusivity_m2_s, const Fractions* fractions)
    : gpu_(&gpu),
      diffusivity_m2_s_(diffusivity_m2_s),
      cell_m_(setup.cell_m),
      fractions_(fractions),
      grids_(multigrid_levels(setup.cells)) {}

Variant Diffusion::variant(std::size_t l) const {
    const glm::ivec3 n = grids_[l];
    Variant v{.layouts = {{"GRID", Cells::layout(n)}, {"FRACTION", Faces4::layout(n)}},
              .defines = {{"CELLS", glsl(n)}}};
    if (l > 0) v.defines.emplace_back("CORRECTION", "");
    const glm::vec3 covered = glm::vec3(grids_[0]) / std::exp2(static_cast<float>(l)) - glm::vec3(n - 1);
    if (fractions_)
        v.defines.emplace_back("CUT", "");
    else if (covered != glm::vec3(1.0f))
        v.defines.emplace_back("LAST_CELL",
                               fmt::format("vec3({:.8f}, {:.8f}, {:.8f})", covered.x, covered.y, covered.z));
    return v;
}

void Diffusion::add_level() {
    const std::size_t l = levels_.size();
    const AtlasLayout here = Cells::layout(grids_[l]);
    const auto name = [](const char* pass, std::size_t level) { return fmt::format("{} {}", pass, level); };
    Level level{
        grids_[l],
        Pass(*gpu_, name("diffusion smooth", l), "gles/fluid/diffusion_smooth.frag", here, variant(l)),
        {},
        {},
        {}};
    if (l > 0) {
        Variant from_zero = variant(l), fine = variant(l - 1);
        from_zero.defines.emplace_back("FROM_ZERO", "");
        level.first_smooth.emplace(*gpu_, name("diffusion smooth from zero", l),
                                   "gles/fluid/diffusion_smooth.frag", here, from_zero);
        level.restrict_to.emplace(*gpu_, name("diffusion restrict", l), "gles/fluid/diffusion_restrict.frag",
                                  here, fine);
        fine.layouts.emplace_back("COARSE", here);
        level.prolong.emplace(*gpu_, name("diffusion prolong", l - 1), "gles/fluid/diffusion_prolong.frag",
                              Cells::layout(grids_[l - 1]), fine);
    }
    levels_.push_back(std::move(level));
}

void Diffusion::draw(Pass& pass, std::size_t l, std::vector<Input> inputs, float lambda,
                     const std::vector<Uniform>& uniforms, const Texture& out) const {
    std::vector<Uniform> all = uniforms;
    all.push_back({"lambda", lambda});
    if (fractions_) {
        const std::vector<Input> a = fractions_->level(l).inputs();
        inputs.insert(inputs.end(), a.begin(), a.end());
    }
    pass.draw(inputs, all, {&out});
}

Field<Cells> Diffusion::smooth(std::size_t l, const Field<Cells>* t, const Field<Cells>& rhs, float lambda,
                               float omega) {
    Level& level = levels_[l];
    Field<Cells> next(*gpu_, level.cells, Format::R32F);
    std::vector<Input> inputs{{"rhs", &rhs.texture()}};
    if (t) inputs.push_back({"field", &t->texture()});
    draw(t ? level.smooth : *level.first_smooth, l, inputs, lambda, {{"omega", omega}}, next.texture());
    return next;
}

Field<Cells> Diffusion::cycle(std::size_t l, const Field<Cells>* guess, const Field<Cells>& rhs,
                              float lambda) {
    const bool coarsest = l + 1 == used_;
    // Before and after the coarser grids: what they cannot hold. On the coarsest: everything.
    const std::vector<float> omegas =
        coarsest ? diffusion_weights(l == 0 ? sweeps_alone(lambda) : kMostSweeps, lambda, 0.08)
                 : diffusion_weights(2, lambda, 1.0 / 3.0);
    Field<Cells> t = smooth(l, guess, rhs, lambda, omegas[0]);
    for (std::size_t i = 1; i < omegas.size(); ++i) t = smooth(l, &t, rhs, lambda, omegas[i]);
    if (coarsest) return t;

    Level& coarse = levels_[l + 1];
    Field<Cells> rhs_coarse(*gpu_, coarse.cells, Format::R32F);
    draw(*coarse.restrict_to, l, {{"field", &t.texture()}, {"rhs", &rhs.texture()}}, lambda, {},
         rhs_coarse.texture());
    const Field<Cells> correction = cycle(l + 1, nullptr, rhs_coarse, 0.25f * lambda);
    Field<Cells> corrected(*gpu_, levels_[l].cells, Format::R32F);
    draw(*coarse.prolong, l, {{"field", &t.texture()}, {"correction", &correction.texture()}}, lambda, {},
         corrected.texture());
    t = std::move(corrected);
    for (const float omega : omegas) t = smooth(l, &t, rhs, lambda, omega);
    return t;
}

Field<Cells> Diffusion::operator()(const Field<Cells>& t_star, double dt_s) {
    const float lambda = static_cast<float>(diffusivity_m2_s_ * dt_s / (cell_m_ * cell_m_));
    used_ = 1;
    for (float coarse = 0.25f * lambda; coarse > kLeastLambda && used_ < grids_.size(); coarse *= 0.25f)
        ++used_;
    while (levels_.size() < used_) add_level();
    Field<Cells> t = cycle(0, &t_star, t_star, lambda);
    // A step with a large lambda leaves little of T*; its error must be little beside that.
    const int cycles = used_ > 1 ? kCycles + static_cast<int>(std::ceil(std::log10(lambda))) : 1;
    for (int i = 1; i < cycles; ++i) t = cycle(0, &t, t_star, lambda);
    return t;
}

}  // namespace eddy::gles
