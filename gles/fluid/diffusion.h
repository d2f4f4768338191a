#pragma once
#include <optional>
#include <vector>

#include "gles/body/fractions.h"
#include "gles/fluid/setup.h"

namespace eddy::gles {

/// Solves   T - kappa dt Laplacian(T) = T*   by multigrid V-cycles: stable and accurate whatever
/// kappa dt / h^2 is. Nothing passes through the tank's walls or into bodies.
///
/// Grids so coarse that neighbours hardly exchange anything in a step (kappa dt / h^2 < 1/16) are left out; for
/// most scenes that is every one but the finest.
class Diffusion {
  public:
    /// `fractions`: null when nothing solid is in the tank. Must outlive this.
    Diffusion(Gpu& gpu, const FluidSetup& setup, double diffusivity_m2_s, const Fractions* fractions);

    Field<Cells> operator()(const Field<Cells>& t_star, double dt_s);

  private:
    struct Level {
        glm::ivec3 cells;
        Pass smooth;
        // From and to the finer grid.
        std::optional<Pass> first_smooth, restrict_to, prolong;
    };
    void add_level();
    /// What the passes are compiled with that read a field on this level.
    Variant variant(std::size_t l) const;
    void draw(Pass& pass, std::size_t l, std::vector<Input> inputs, float lambda,
              const std::vector<Uniform>& uniforms, const Texture& out) const;
    /// One sweep; t null: from zero.
    Field<Cells> smooth(std::size_t l, const Field<Cells>* t, const Field<Cells>& rhs, float lambda,
                        float omega);
    Field<Cells> cycle(std::size_t l, const Field<Cells>* t, const Field<Cells>& rhs, float lambda);

    Gpu* gpu_;
    double diffusivity_m2_s_, cell_m_;
    const Fractions* fractions_;
    std::vector<glm::ivec3> grids_;
    std::vector<Level> levels_;  ///< made when a step first needs them
    std::size_t used_ = 1;       ///< of them, in this step
};

}  // namespace eddy::gles
