// sharpen_fractions.frag     a += gain(a, next) + gain(a, previous)        along each face's own axis, gain = (a - a_nb) min(a, a_nb) / 4
//
// reads   ax, ay, az     RGBA32F  Faces4 (nx+1, ny+1, nz+1)            0 solid .. 1 fluid
// writes  ax, ay, az     RGBA32F  Faces4                               the same sum along every row of faces; may exceed 1
// fetches 9
//
// A staggered cell's share is the face's own open share averaged over one cell across the face. f = <f> - h^2/24 f'' would
// undo that to second order; without it the flow turns around a body a little too easily. But shares have kinks, and a
// closed face has nothing to give. This gain is smooth and leaves closed faces closed; where a flat surface lies along the
// grid (shares 0, s, 1) it moves s (1 - s) / 4, on average over s the 1/24 that f'' would. What one face gains its
// neighbour gives, so a row's sum stays what it was, and with it the body's volume.
#include "open.glsl"

uniform sampler2D ax, ay, az;

layout(location = 0) out vec4 out_ax;
layout(location = 1) out vec4 out_ay;
layout(location = 2) out vec4 out_az;

// What `here` gains from its neighbour.
vec4 gain(vec4 here, vec4 there) {
    return 0.25 * (here - there) * min(here, there);
}

vec4 sharpened(sampler2D a, ivec3 c, ivec3 e) {
    vec4 here = share(at(a, TARGET, c));
    return here + gain(here, share(at_clamped(a, TARGET, c + e))) + gain(here, share(at_clamped(a, TARGET, c - e)));
}

void main() {
    ivec3 c = cell_here(TARGET);
    out_ax = sharpened(ax, c, ivec3(1, 0, 0));
    out_ay = sharpened(ay, c, ivec3(0, 1, 0));
    vec4 z = share(at(az, TARGET, c));
    vec4 below = vec4(share(at_clamped(az, TARGET, c - ivec3(0, 0, 1))).w, z.xyz);
    vec4 above = vec4(z.yzw, share(at_clamped(az, TARGET, c + ivec3(0, 0, 1))).x);
    if (c.z == 0) below.x = z.x;  // beyond the tank there is nothing to give
    above = mix(above, z, greaterThanEqual(4 * c.z + ivec4(0, 1, 2, 3), ivec4(CELLS.z)));
    out_az = z + gain(z, above) + gain(z, below);
}
