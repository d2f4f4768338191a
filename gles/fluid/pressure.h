#pragma once
#include <optional>
#include <vector>

#include "gles/body/displacement.h"
#include "gles/body/fractions.h"
#include "gles/fluid/least_residual.h"
#include "gles/fluid/no_limit.h"
#include "gles/fluid/walls.h"

namespace eddy::gles {

/// The grids of the multigrid solver for n cells: n, then halves (rounded up, so that any n works: the
/// missing cells of an odd grid are closed) down to at most 4 cells an axis.
std::vector<glm::ivec3> multigrid_levels(const glm::ivec3& n);

/// Solves   sum_f a_f (phi_nb - phi) = b   in every cell, where phi = dt p / (rho h) [m/s].
///
/// V-cycles with two Chebyshev-weighted Jacobi sweeps before and after; residuals are summed to coarse cells,
/// coarse corrections come back trilinearly. Equations are written for a cell width of 1 on every level:
/// fractions are averaged, and a coarse right-hand side is half the sum of eight fine residuals (four faces,
/// twice the distance). Near bodies the sweeps read face fractions; elsewhere, one large draw without them.
///
/// Two things make few cycles enough for moving bodies and strong sources, and cost little because they are
/// drawn around them only: the last pressure is shifted along with a body before it serves as first guess
/// (follow.frag), and the last cycle ends with two more sweeps there, where nearly all of the residual is.
///
/// A plate of a few cells or less is on the wrong side of some cell on every coarse grid, and cycles beside it leave 0.6 to
/// 0.9 of the residual, or diverge. There each cycle only proposes a correction (least_residual.h).
class Pressure {
  public:
    /// `fractions`: null when nothing solid is in the tank. Must outlive this.
    /// `from_zero`: solve() without a guess will be called.
    Pressure(Gpu& gpu, const glm::ivec3& cells, const Fractions* fractions, const Walls& walls,
             bool from_zero = false);

    /// Moves phi along with the bodies, to serve as first guess for where they are now. Beyond `most_phi` it counts as 0.
    Field<Cells4> follow(Field<Cells4> phi, const std::vector<Displacement>& since,
                         float most_phi = kNoLimit);
    struct Work {
        int cycles = 2;             ///< V-cycles
        float guess_scale = 1.0f;   ///< the first guess is this times phi, which grows with dt
        float most_phi = kNoLimit;  ///< of the guess; see kept() in guard.glsl
        std::vector<Box> cut{};     ///< cells whose fractions may not be 1
        std::vector<Box> rough{};   ///< those, and all where b jumps from cell to cell: swept twice more
    };
    /// A better phi for right-hand side b.
    Field<Cells4> solve(Field<Cells4> phi, const Field<Cells4>& b, const Work& work);
    /// The same, from phi = 0.
    Field<Cells4> solve(const Field<Cells4>& b, const Work& work);

  private:
    /// A pass in both variants: `plain` for the whole grid and `cut` for the boxes of solids over it.
    struct Split {
        Pass plain;
        std::optional<Pass> cut;
    };
    struct Level {
        glm::ivec3 cells;
        bool split;  ///< a plain sweep of the whole grid and a cut one of the boxes over it cost less than
                     ///< one cut sweep
        std::optional<Split> guess_sweep;  ///< of a guess; only the finest has it
        std::optional<Split> first_sweep, sweep, restrict, prolong;
        std::optional<Split> solve;  ///< the coarsest has only this
        std::vector<Box> boxes;
    };

    Split make(Gpu& gpu, const char* name, const char* shader, std::size_t level, const AtlasLayout& target,
               Variant variant, const Walls& walls);
    void draw(Split& pass, std::size_t level, std::vector<Input> inputs, const std::vector<Uniform>& uniforms,
              const Texture& out, const std::vector<Box>& boxes, const Region& where = Region::everything());
    /// What a guess is multiplied by, and how large it may be.
    struct Guess {
        float scale, most_phi;
    };
    Field<Cells4> sweep(std::size_t l, const Field<Cells4>& phi, const std::optional<Guess>& guess,
                        const Field<Cells4>& b, float omega);
    Field<Cells4> sweep_from_zero(std::size_t l, const Field<Cells4>& b, float omega);
    void sweep_rough(Field<Cells4>& phi, const Field<Cells4>& b, const std::vector<Box>& boxes);
    Field<Cells4> cycles(std::optional<Field<Cells4>> phi, const Field<Cells4>& b, const Work& work);
    Field<Cells4> residual(const Field<Cells4>& phi, const Field<Cells4>& b);
    Field<Cells4> least_residual_cycles(const std::optional<Field<Cells4>>& guess, const Field<Cells4>& b,
                                        const Work& work);
    Field<Cells4> cycle(std::size_t l, std::optional<Field<Cells4>> phi, const std::optional<Guess>& guess,
                        const Field<Cells4>& b);

    Gpu* gpu_;
    const Fractions* fractions_;
    std::vector<float> solver_;  ///< weights of the sweeps on the coarsest grid
    std::vector<Level> levels_;
    std::optional<Pass> follow_, copy_back_;
    std::optional<LeastResidual> least_residual_;  ///< with thin bodies
    std::optional<Pass> keep_;
    std::optional<Split> residual_;
};

/// Relaxation weights of m weighted-Jacobi sweeps that together damp the eigenvalues [low, high] of D^-1 A as
/// the Chebyshev polynomial of degree m does, in the order of Lebedev and Finogenov, which keeps every
/// partial product small (natural order overflows 32-bit floats for m around 20).
std::vector<float> chebyshev_weights(int m, double low, double high);

/// The same for (1 - lambda laplacian): eigenvalues between 1 / (1 + 6 lambda) and twice 1 less that, damped down to `low`.
std::vector<float> diffusion_weights(int m, float lambda, double low);

}  // namespace eddy::gles
