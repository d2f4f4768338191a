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

float lane(sampler2D a, ivec3 c) {
    return lane(share(at(a, FRACTION, ivec3(c.xy, c.z >> 2))), c.z);  // guard shares
}
#endif

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 x = vec3(c);
    d = vec4(solid_distance(SCALE * (x + vec3(0.0, 0.5, 0.5))), solid_distance(SCALE * (x + vec3(0.5, 0.0, 0.5))),
             solid_distance(SCALE * (x + vec3(0.5, 0.5, 0.0))), 0.0) / SCALE;
#ifndef COARSE
    v = vec4(lane(ax, c), lane(ay, c), lane(az, c), 0.0);
#else
    v = smoothstep(-kReach, kReach, d);
#endif
}
