#pragma once
#include <optional>

#include "gles/field.h"
#include "gles/fluid/walls.h"
#include "gles/reduce.h"

namespace eddy::gles {

/// Looks at the whole tank after a step on a staggered grid. Nothing is made before it is first asked for.
class Diagnosis {
  public:
    Diagnosis(Gpu& gpu, const FluidSetup& setup) : gpu_(&gpu), setup_(&setup) {}

    struct Tank {
        const Field<Faces>& velocity;
        const Field<Cells4>& before;      ///< what flows out of each cell before the projection [m/s]
        const Field<Cells4>& after;       ///< and after it
        const Field<Cells>* smoke;        ///< null: there is none
        const Field<Cells>* temperature;  ///< null: there is none
    };
    /// Writes into the texels of `row` that Results sets aside for it.
    void draw(const Tank& tank, const Texture& row);

  private:
    void make(const Tank& tank);

    Gpu* gpu_;
    const FluidSetup* setup_;
    std::optional<Pass> columns_;
    std::optional<Reduce> sum_, sum_heat_;
};

}  // namespace eddy::gles
