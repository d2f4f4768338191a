#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "gles/body/shapes.h"
#include "gles/fluid/fluid.h"
#include "gles/pass.h"
#include "gles/render/camera.h"
#include "gles/render/window.h"

namespace eddy::gles {

/// The picture: where from, how large, how it is lit.
struct RenderSetup {
    int width_px = 640;
    int height_px = 480;
    double azimuth_deg = 20.0;  ///< see Camera
    double elevation_deg = 15.0;
    double distance = 1.5;
    double optical_density_1_m = 40.0;  ///< light falls to 1/e in 1 / this through smoke of density 1
    glm::dvec3 smoke_colour{0.90, 0.93, 0.97};
    glm::dvec3 background_colour{0.02, 0.03, 0.06};
    double exposure = 1.0;
    glm::dvec3 to_key{-0.66, 0.66, 0.30};  ///< direction towards the key light, Tank frame; any length
    int steps = 96;               ///< of a ray along the diagonal of the tank; shorter rays take fewer
    bool half_resolution = true;  ///< smoke is marched for every second pixel in x and y, and interpolated
};

/// Draws the tank, the smoke and the bodies into a texture. GL thread only. What the scene has not (smoke,
/// bodies) costs nothing: no texture, no pass, no branch.
class Renderer {
  public:
    Renderer(Gpu& gpu, const FluidSetup& fluid, const RenderSetup& setup);

    /// `bodies` as they were given to the fluid's last step.
    void draw(const Fluid& fluid, const std::vector<BodyState>& bodies);

    /// RGBA8, first row at the bottom.
    const Texture& picture() const { return *picture_; }
    /// Waits for the GPU. Three bytes a pixel, first row at the top.
    std::vector<std::uint8_t> rgb() const { return rgb_from_top(gpu_, *picture_); }
    /// Key light (r) and fill light (g) that arrive in each cell of half the grid (of ceil(n / 2) cells), 0
    /// .. 1, as last drawn.
    const Field<Cells>& light() const { return light_; }

  private:
    Gpu& gpu_;
    RenderSetup setup_;
    double cell_m_;
    glm::ivec2 march_size_;
    BodyUniforms body_uniforms_;
    Field<Cells> light_;
    TexturePool::Lease picture_;

    Pass draw_light_;
    std::optional<Pass> pair_smoke_, pair_light_, march_smoke_;
    Pass draw_picture_;
};

}  // namespace eddy::gles
