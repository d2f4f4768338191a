// resample_velocity.frag     u(x) = u_source(x), the velocity on another grid of the same tank, trilinear
//
// reads   source   RGBA32F  Faces of SOURCE_CELLS; variant FROM_CENTRES: Cells     [m/s]
// writes  u        RGBA32F  Faces of CELLS; variant TO_CENTRES: Cells              [m/s]
// fetches 24, FROM_CENTRES+TO_CENTRES 8
//
// A face midway between four others gets their mean, so a grid of half as many cells gets the same flow through its faces.
// In the upper layers of Faces what no face owns repeats its neighbour (velocity.glsl).
#define VALUE vec3
#include "trilinear.glsl"

uniform sampler2D source;

out vec4 result;

vec3 value(ivec3 c) {
    return at(source, SOURCE, c).xyz;
}

// All of the velocity at x [cells of the target], where one component suffices: that along `axis`.
vec3 velocity_along(int axis, vec3 x) {
    x *= vec3(SOURCE_CELLS) / vec3(CELLS);
#ifdef FROM_CENTRES
    return trilinear(x - 0.5, SOURCE_CELLS - 1);
#else
    ivec3 own = ivec3(equal(ivec3(axis), ivec3(0, 1, 2)));
    return trilinear(x - 0.5 * vec3(1 - own), SOURCE_CELLS - 1 + own);
#endif
}

void main() {
    ivec3 c = cell_here(TARGET);
#ifdef TO_CENTRES
    vec3 x = vec3(c) + 0.5;
#ifdef FROM_CENTRES
    result = vec4(velocity_along(0, x), 0.0);
#else
    result = vec4(velocity_along(0, x).x, velocity_along(1, x).y, velocity_along(2, x).z, 0.0);
#endif
#else
    vec3 x = vec3(c), m = vec3(min(c, CELLS - 1)) + 0.5;
    result = vec4(velocity_along(0, vec3(x.x, m.yz)).x, velocity_along(1, vec3(m.x, x.y, m.z)).y,
                  velocity_along(2, vec3(m.xy, x.z)).z, 0.0);
#endif
}
