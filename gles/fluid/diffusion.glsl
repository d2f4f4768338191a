// diffusion.glsl     The equation  V T - lambda sum_f a_f (T_nb - T) = V rhs  over the six faces of a cell; V: the fluid's share
//
// field: T, Cells, of layout GRID with CELLS cells. Nothing flows through the tank's walls, where clamping makes T_nb = T, nor into
// bodies: away from them every a is 1; variant CUT reads a from Faces4. V is the mean of the six.
// Variant LAST_CELL as in poisson.glsl.
uniform sampler2D field;

#ifdef CUT
#include "open.glsl"

uniform sampler2D ax, ay, az;

// Of the lower and upper faces of a cell.
void openings(ivec3 c, out vec3 low, out vec3 high) {
    ivec3 here = ivec3(c.xy, c.z >> 2), above = ivec3(c.xy, (c.z + 1) >> 2);
    low = vec3(share_in(ax, FRACTION, here, c.z), share_in(ay, FRACTION, here, c.z), share_in(az, FRACTION, here, c.z));
    high = vec3(share_in(ax, FRACTION, here + ivec3(1, 0, 0), c.z), share_in(ay, FRACTION, here + ivec3(0, 1, 0), c.z),
                share_in(az, FRACTION, above, c.z + 1));
}
#else
void openings(ivec3 c, out vec3 low, out vec3 high) {
    low = vec3(1.0);
    high = vec3(1.0);
#ifdef LAST_CELL
    vec3 last = vec3(equal(c + 1, CELLS)), s = mix(vec3(1.0), LAST_CELL, last);
    low = s.yzx * s.zxy;
    high = low * mix(vec3(1.0), floor(LAST_CELL), last);
#endif
}
#endif

uniform sampler2D rhs;
uniform float lambda;  // kappa dt / h^2 on this grid

// Of the equation  V T - lambda inflow(T) = V rhs;  on coarse grids (CORRECTION) rhs is a residual and holds V already.
// share: V; centre: T itself.
float residual(ivec3 c, out float share, out float centre) {
    vec3 low, high;
    openings(c, low, high);
    share = dot(low + high, vec3(1.0 / 6.0));
    float inflow = 0.0;
    centre = 0.0;
#ifndef FROM_ZERO
    centre = at(field, GRID, c).x;
    vec3 below = vec3(at_clamped(field, GRID, c - ivec3(1, 0, 0)).x, at_clamped(field, GRID, c - ivec3(0, 1, 0)).x,
                      at_clamped(field, GRID, c - ivec3(0, 0, 1)).x);
    vec3 above = vec3(at_clamped(field, GRID, c + ivec3(1, 0, 0)).x, at_clamped(field, GRID, c + ivec3(0, 1, 0)).x,
                      at_clamped(field, GRID, c + ivec3(0, 0, 1)).x);
    inflow = dot(low, below - centre) + dot(high, above - centre);
#endif
#ifdef CORRECTION
    return at(rhs, GRID, c).x - share * centre + lambda * inflow;
#else
    return share * (at(rhs, GRID, c).x - centre) + lambda * inflow;
#endif
}
