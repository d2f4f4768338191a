// distances.frag     d = signed distance of each face to the nearest body's surface, negative inside;  v = the fluid's share
//
// reads   the bodies' shapes and poses (uniforms)                      [cells]
// reads   ax, ay, az  RGBA32F  Faces4                                  not by variant COARSE
// writes  d, v        RGBA32F  Faces (nx+1, ny+1, nz+1) of a grid SCALE times as coarse     [cells of that grid]
// fetches 3, COARSE 0
//
// Variant COARSE: grids that serve as corrections only; there v follows from d.
#ifndef COARSE
uniform sampler2D ax, ay, az;
#endif

layout(location = 0) out vec4 d;
layout(location = 1) out vec4 v;

#include "reach.glsl"

#ifndef COARSE
#include "open.glsl"
#endif

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 x = vec3(c);
    d = vec4(solid_distance(SCALE * (x + vec3(0.0, 0.5, 0.5))), solid_distance(SCALE * (x + vec3(0.5, 0.0, 0.5))),
             solid_distance(SCALE * (x + vec3(0.5, 0.5, 0.0))), 0.0) / SCALE;
#ifndef COARSE
    ivec3 slab = ivec3(c.xy, c.z >> 2);
    v = vec4(share_in(ax, FRACTION, slab, c.z), share_in(ay, FRACTION, slab, c.z), share_in(az, FRACTION, slab, c.z), 0.0);
#else
    v = smoothstep(-kReach, kReach, d);
#endif
}
