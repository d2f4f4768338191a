#pragma once
#include "gles/atlas.h"
#include "gles/gpu.h"

namespace eddy::gles {

/// A field on a grid, in a texture leased from the pool. `Storage` (Cells, Faces, Cells4, Faces4) is part of
/// the type, so a pass that wants faces cannot be given cells. Passes take fields by reference, and return
/// new ones; a field that is assigned over gives its texture back.
template <class Storage>
class Field {
  public:
    Field() = default;
    /// Content unknown until a pass writes it.
    Field(Gpu& gpu, const glm::ivec3& cells, Format format)
        : cells_(cells), texture_(gpu.textures().lease(Storage::layout(cells).texels(), format)) {}

    const Texture& texture() const { return *texture_; }
    Texture& texture() { return *texture_.get(); }
    /// Cells of the grid it belongs to (not texels of its layout).
    glm::ivec3 cells() const { return cells_; }
    AtlasLayout layout() const { return Storage::layout(cells_); }
    explicit operator bool() const { return static_cast<bool>(texture_); }

  private:
    glm::ivec3 cells_{0};
    TexturePool::Lease texture_;
};

}  // namespace eddy::gles
