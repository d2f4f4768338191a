#pragma once
#include <optional>

#include "gles/field.h"
#include "gles/reduce.h"

namespace eddy::gles {

/// Conjugate residuals with the multigrid cycle as preconditioner, ORTHOMIN(1) of Vinsome 1976: of every correction z that a
/// cycle proposes for  A phi = b,  mixed with the direction taken last, only so much is taken as leaves the least residual.
/// However badly a cycle fits its equation, it then cannot make the residual grow; and one that leaves 0.85 leaves about half.
/// A residual that is not a number somewhere is not corrected at all.
class LeastResidual {
  public:
    LeastResidual(Gpu& gpu, const glm::ivec3& cells);

    /// Forgets the last direction: another equation follows.
    void restart();
    /// Moves phi and its residual r = b - A phi. r_z = r - A z.
    void correct(Field<Cells4>& phi, Field<Cells4>& r, const Field<Cells4>& z, const Field<Cells4>& r_z);

  private:
    struct Passes {
        Pass products, step;
    };
    Passes make(bool first) const;

    Gpu* gpu_;
    glm::ivec3 cells_;
    TexturePool::Lease products_;
    Passes first_, next_;
    Reduce sum_;
    /// The last direction, and A of it; none after restart(). Nobody says which cycle is the last: they are held until the
    /// next equation, and the rest of a step does without these two textures.
    Field<Cells4> p_, q_;
};

}  // namespace eddy::gles
