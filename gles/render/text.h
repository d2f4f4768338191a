#pragma once
#include "gles/pass.h"
#include "gles/render/page.h"

namespace eddy::gles {

/// Lays a page of text over a picture. GL thread only. The page is composed by the CPU when it says something new, which
/// is seldom, and laid over each picture by one draw of its own rectangle. An empty page costs nothing.
class Text {
  public:
    /// `picture`, RGBA8 with its first row at the bottom, must outlive this.
    Text(Gpu& gpu, const Texture& picture);

    void draw(const Page& page);

  private:
    Gpu& gpu_;
    const Texture& picture_;
    Font font_;
    Page composed_;  // what page_ holds
    TexturePool::Lease page_;
    Pass lay_;
};

}  // namespace eddy::gles
