#pragma once
#include <optional>
#include <vector>

#include "gles/field.h"
#include "gles/fluid/setup.h"
#include "gles/pass.h"

namespace eddy::gles {

/// Sources that drive the fluid.
class Jets {
  public:
    Jets(Gpu& gpu, const FluidSetup& setup);
    bool any() const { return drive_.has_value(); }
    /// Gives the fluid inside those that run their velocity.
    Field<Faces> drive(Field<Faces> u, double time_s);
    /// The cells that those that run may touch.
    std::vector<Box> boxes(double time_s) const;

  private:
    double cell_m_;
    glm::ivec3 cells_;
    std::vector<SourceSetup> sources_;
    std::optional<Pass> drive_;
};

}  // namespace eddy::gles
