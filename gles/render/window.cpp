#include "gles/render/window.h"

#include <GLES3/gl3.h>

#include <algorithm>

namespace eddy::gles {

std::vector<std::uint8_t> rgb_from_top(Gpu& gpu, const Texture& picture) {
    const glm::ivec2 size = picture.size();
    std::vector<std::uint8_t> rgba(4 * static_cast<std::size_t>(size.x * size.y));
    glBindFramebuffer(GL_FRAMEBUFFER, gpu.framebuffer({&picture}));
    glReadPixels(0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    std::vector<std::uint8_t> result;
    result.reserve(rgba.size() / 4 * 3);
    for (int y = size.y - 1; y >= 0; --y)
        for (int x = 0; x < size.x; ++x) {
            const std::uint8_t* pixel = &rgba[4 * static_cast<std::size_t>(y * size.x + x)];
            result.insert(result.end(), pixel, pixel + 3);
        }
    return result;
}

void show_in_window(Gpu& gpu, const Texture& picture, const glm::ivec2& window_px) {
    const glm::ivec2 size = picture.size();
    const double scale =
        std::min(static_cast<double>(window_px.x) / size.x, static_cast<double>(window_px.y) / size.y);
    const glm::ivec2 shown(glm::round(scale * glm::dvec2(size)));
    const glm::ivec2 low = (window_px - shown) / 2;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, gpu.framebuffer({&picture}));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glBlitFramebuffer(0, 0, size.x, size.y, low.x, low.y, low.x + shown.x, low.y + shown.y,
                      GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

}  // namespace eddy::gles
