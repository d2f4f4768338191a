#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "gles/gpu.h"

namespace eddy::gles {

// What becomes of a finished picture: RGBA8, first row at the bottom.

/// Waits for the GPU. Three bytes a pixel, first row at the top.
std::vector<std::uint8_t> rgb_from_top(Gpu& gpu, const Texture& picture);

/// Copies a picture to the window, the default framebuffer, as large as fits, black beside it.
void show_in_window(Gpu& gpu, const Texture& picture, const glm::ivec2& window_px);

}  // namespace eddy::gles
