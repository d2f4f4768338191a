// fractions.frag     a = the fluid's share of the staggered cell around each face
//
// reads   the bodies' shapes and poses (uniforms)                      [cells]
// writes  ax, ay, az     RGBA32F  Faces4 (nx+1, ny+1, nz+1)            0 solid .. 1 fluid; walls of the tank not included
// fetches 0
#include "fraction.glsl"

layout(location = 0) out vec4 ax;
layout(location = 1) out vec4 ay;
layout(location = 2) out vec4 az;

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 low = vec3(c.xy, 4 * c.z);
    for (int lane = 0; lane < 4; ++lane) {
        vec3 corner = low + vec3(0.0, 0.0, lane);
        ax[lane] = fluid_fraction_at(corner + vec3(0.0, 0.5, 0.5), vec3(1.0, 0.0, 0.0));
        ay[lane] = fluid_fraction_at(corner + vec3(0.5, 0.0, 0.5), vec3(0.0, 1.0, 0.0));
        az[lane] = fluid_fraction_at(corner + vec3(0.5, 0.5, 0.0), vec3(0.0, 0.0, 1.0));
    }
}
