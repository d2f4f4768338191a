#pragma once
#include <map>
#include <string>

#include "gles/field.h"
#include "gles/pass.h"

namespace eddy::gles {

/// Fields of another grid of the same tank, or of the same grid and stored otherwise, as they are on this one. A field that
/// is already what is asked for is copied bit for bit. Passes are made when they are first needed.
class Resample {
  public:
    Resample(Gpu& gpu, const glm::ivec3& cells) : gpu_(&gpu), cells_(cells) {}

    /// Velocity, on Faces or at the centres of Cells.
    Field<Faces> on_faces(const Field<Faces>& u);
    Field<Faces> on_faces(const Field<Cells>& u);
    Field<Cells> at_centres(const Field<Faces>& u);
    Field<Cells> at_centres(const Field<Cells>& u);
    /// A quantity of cells, times `gain` unless it is copied.
    Field<Cells> in_cells(const Field<Cells>& s, float gain = 1.0f);
    Field<Cells> in_cells(const Field<Cells4>& s, float gain);
    Field<Cells4> in_fours(const Field<Cells4>& s, float gain);
    Field<Cells4> in_fours(const Field<Cells>& s, float gain);

  private:
    template <class To, class From>
    Field<To> draw(const char* shader, const Field<From>& source, Format format, Variant variant,
                   const std::vector<Uniform>& uniforms);
    Pass& pass(const char* shader, const AtlasLayout& target, const Variant& variant);

    Gpu* gpu_;
    glm::ivec3 cells_;
    std::map<std::string, Pass> passes_;  ///< by their names, which say all that tells them apart
};

}  // namespace eddy::gles
