#include "firmware/render_setup.h"

namespace eddy {

gles::RenderSetup render_setup(const Scene& scene) {
    gles::RenderSetup r;
    r.width_px = scene.render.width_px;
    r.height_px = scene.render.height_px;
    r.azimuth_deg = scene.render.azimuth_deg;
    r.elevation_deg = scene.render.elevation_deg;
    r.distance = scene.render.distance_factor;
    r.optical_density_1_m = scene.render.extinction_1_m;
    r.smoke_colour = scene.render.smoke_colour;
    r.background_colour = scene.render.background_colour;
    r.exposure = scene.render.exposure;
    return r;
}

}  // namespace eddy
