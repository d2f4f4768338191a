#include "gles/render/fill.h"

#include <GLES3/gl3.h>

namespace eddy::gles {

void fill(Gpu& gpu, const Texture& picture, const glm::ivec2& low, const glm::ivec2& size,
          const glm::vec3& colour) {
    const glm::ivec2 extent = glm::max(size, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, gpu.framebuffer({&picture}));
    glEnable(GL_SCISSOR_TEST);
    glScissor(low.x, low.y, extent.x, extent.y);
    glClearColor(colour.x, colour.y, colour.z, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace eddy::gles
