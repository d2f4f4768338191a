#pragma once
#include <optional>
#include <vector>

#include "gles/body/grip.h"
#include "gles/fluid/walls.h"

namespace eddy::gles {

/// Solves   u - nu dt Laplacian(u) = u*   for the three velocity components together, by multigrid V-cycles:
/// stable and accurate whatever nu dt / h^2 is. The fluid sticks to bodies, wherever their surface cuts the
/// grid, and to walls that say so.
///
/// A component's coarse faces are every second fine one along its own axis; the equation is written anew on
/// each grid, for the grid's own distances to the bodies. Near bodies it is weighted with the fluid's share of each
/// face's cell, the same that the pressure equation has: then the two steps together cannot gain energy. Grids so coarse that neighbours hardly exchange
/// momentum in a step (nu dt / h^2 < 1/8) are left out.
class ViscousTerm {
  public:
    ViscousTerm(Gpu& gpu, const FluidSetup& setup, const Walls& walls);

    /// Draws where the bodies hold the fluid now; `boxes` hold each body and two cells around it.
    void place(const BodyUniforms& bodies, const std::vector<Box>& boxes, const FaceFractions& fractions);
    /// u after `cycles` V-cycles from a guess, which is none where it is faster than `most_m_s`; u* also holds the
    /// velocities on walls and in bodies.
    Field<Faces> diffuse(const Field<Faces>& guess, float most_m_s, const Field<Faces>& u_star, double dt_s,
                         int cycles, const Uniform& wall_time);
    /// Where the bodies hold the fluid; null without bodies.
    const Grip* grip() const { return grip_ ? &*grip_ : nullptr; }

  private:
    /// A pass for the whole grid, and the one that knows of bodies for their boxes over it.
    struct Split {
        Pass plain;
        std::optional<Pass> cut;
    };
    struct Level {
        glm::ivec3 cells;
        std::optional<Split> guess_smooth;  ///< of a guess; only the finest has it
        std::optional<Split> first_smooth, smooth, residual, prolong;
        std::optional<Pass> restrict_to;  ///< this level, from the finer one
    };
    struct Equation {
        float lambda;  ///< nu dt / h^2 on the finest grid
        float on(std::size_t level) const;
        std::size_t levels;
        std::vector<Uniform> uniforms;
    };

    Split make(Gpu& gpu, const char* name, const char* shader, std::size_t l, Variant variant,
               const Walls& walls) const;
    void draw(Split& pass, std::size_t l, std::vector<Input> inputs, std::vector<Uniform> uniforms,
              const Equation& equation, const Texture& out);
    /// One sweep; u null: from zero; `most_m_s` if u is a guess.
    Field<Faces> smooth(std::size_t l, const Field<Faces>* u, std::optional<float> most_m_s,
                        const Field<Faces>& rhs, float omega, const Equation& equation);
    Field<Faces> cycle(std::size_t l, const Field<Faces>* u, std::optional<float> most_m_s,
                       const Field<Faces>& rhs, const Equation& equation);

    Gpu* gpu_;
    const FluidSetup* setup_;
    std::vector<Level> levels_;
    std::optional<Grip> grip_;
};

}  // namespace eddy::gles
