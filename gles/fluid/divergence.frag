// divergence.frag     b = sum over the faces of a cell, outward:  a u + (1 - a) u_solid
//
// reads   velocity    RGBA32F  Faces (nx+1, ny+1, nz+1)    [m/s]
// reads   ax, ay, az  RGBA32F  Faces4                      fluid fraction (variant CUT)
// writes  b           RGBA32F  Cells4 (nx, ny, nz)         [m/s]   times h^2: volume flowing out of the cell per second
// fetches 13, CUT 19, CUT+AT_REST 6
//
// Variants: plain for cells away from solids; CUT near them; AT_REST where only solids move. Tank walls let nothing
// through; with THROUGH, some do (walls.h).
#include "open.glsl"

#ifdef AT_REST
vec3 fluid_velocity(ivec3 c) {
    return vec3(0.0);
}
#else
uniform sampler2D velocity;

vec3 fluid_velocity(ivec3 c) {
    return at(velocity, FACES, c).xyz;
}
#endif

out vec4 b;

#ifdef CUT
uniform sampler2D ax, ay, az;
#ifndef AT_REST
uniform float through_gaps;  // how fast fluid passes a gap at most  [m/s]
#endif
#endif

#ifdef THROUGH
// What flows through a wall's faces beside four cells: through an inflow what it says, through an open wall what there is.
vec4 flows(int wall, vec4 u, ivec3 c, vec3 face) {
    int axis = wall / 2;
    float inflow = wall % 2 == 0 ? INFLOW_LOW[axis] : INFLOW_HIGH[axis];
    vec3 x = vec3(c.xy, 4 * c.z) + face;
    vec4 given;
    for (int lane = 0; lane < 4; ++lane) given[lane] = wall_velocity(wall, x + vec3(0.0, 0.0, lane))[axis];
    return mix(u, given, inflow);
}
#endif

// Of what goes through the faces of four cells, the walls' share: none where they are closed.
void at_walls(ivec3 c, vec3 low, vec3 high, inout vec4 xl, inout vec4 xh, inout vec4 yl, inout vec4 yh, inout vec4 zl, inout vec4 zh) {
    ivec4 z = 4 * c.z + ivec4(0, 1, 2, 3);
    xl *= c.x > 0 ? 1.0 : low.x;
    xh *= c.x + 1 < CELLS.x ? 1.0 : high.x;
    yl *= c.y > 0 ? 1.0 : low.y;
    yh *= c.y + 1 < CELLS.y ? 1.0 : high.y;
    zl *= mix(vec4(low.z), vec4(1.0), vec4(greaterThan(z, ivec4(0))));
    zh *= mix(vec4(high.z), vec4(1.0), vec4(lessThan(z + 1, ivec4(CELLS.z))));
}

void main() {
    ivec3 c = cell_here(TARGET);
    ivec3 n = CELLS;
    vec4 low_x, high_x, low_y, high_y, w;
    float top = 0.0;
    for (int lane = 0; lane < 4; ++lane) {
        ivec3 f = ivec3(c.xy, min(4 * c.z + lane, n.z));
        vec3 u = fluid_velocity(f);
        low_x[lane] = u.x;
        low_y[lane] = u.y;
        w[lane] = u.z;
        high_x[lane] = fluid_velocity(f + ivec3(1, 0, 0)).x;
        high_y[lane] = fluid_velocity(f + ivec3(0, 1, 0)).y;
    }
    top = fluid_velocity(ivec3(c.xy, min(4 * c.z + 4, n.z))).z;
    vec4 low_z = w, high_z = vec4(w.yzw, top);
    vec4 z = float(4 * c.z) + vec4(0.0, 1.0, 2.0, 3.0);

#ifdef THROUGH
    if (c.x == 0) low_x = flows(0, low_x, c, vec3(0.0, 0.5, 0.5));
    if (c.x + 1 == n.x) high_x = flows(1, high_x, c, vec3(1.0, 0.5, 0.5));
    if (c.y == 0) low_y = flows(2, low_y, c, vec3(0.5, 0.0, 0.5));
    if (c.y + 1 == n.y) high_y = flows(3, high_y, c, vec3(0.5, 1.0, 0.5));
    vec4 at_low = vec4(lessThanEqual(z, vec4(0.0))), at_high = vec4(greaterThanEqual(z + 1.0, vec4(n.z)));
    low_z = mix(low_z, flows(4, low_z, c, vec3(0.5, 0.5, 0.0)), at_low);
    high_z = mix(high_z, flows(5, high_z, c, vec3(0.5, 0.5, 1.0)), at_high);
    // Where fluid goes through; where pressure drives it.
    vec3 open_low = min(OPEN_LOW + INFLOW_LOW, 1.0), open_high = min(OPEN_HIGH + INFLOW_HIGH, 1.0);
    vec3 free_low = min(OPEN_LOW, 1.0), free_high = min(OPEN_HIGH, 1.0);
#else
    const vec3 open_low = vec3(0.0), open_high = vec3(0.0), free_low = vec3(0.0), free_high = vec3(0.0);
#endif

    at_walls(c, open_low, open_high, low_x, high_x, low_y, high_y, low_z, high_z);

#ifdef CUT
    vec4 lx = at(ax, FRACTION, c), hx = at(ax, FRACTION, c + ivec3(1, 0, 0));
    vec4 ly = at(ay, FRACTION, c), hy = at(ay, FRACTION, c + ivec3(0, 1, 0));
    vec4 lz = at(az, FRACTION, c), hz = upper_z(az, FRACTION, c, lz);
    // guard solid_through_wall: a body goes through walls as through any face; else it would press on what is left beside it there.
    for (int lane = 0; lane < 4; ++lane) {
        vec3 x = vec3(c.xy, z[lane]);
        low_x[lane] = mix(solid_velocity(x + vec3(0.0, 0.5, 0.5)).x, low_x[lane], lx[lane]);
        high_x[lane] = mix(solid_velocity(x + vec3(1.0, 0.5, 0.5)).x, high_x[lane], hx[lane]);
        low_y[lane] = mix(solid_velocity(x + vec3(0.5, 0.0, 0.5)).y, low_y[lane], ly[lane]);
        high_y[lane] = mix(solid_velocity(x + vec3(0.5, 1.0, 0.5)).y, high_y[lane], hy[lane]);
        low_z[lane] = mix(solid_velocity(x + vec3(0.5, 0.5, 0.0)).z, low_z[lane], lz[lane]);
        high_z[lane] = mix(solid_velocity(x + vec3(0.5, 0.5, 1.0)).z, high_z[lane], hz[lane]);
    }
#endif

    b = (high_x - low_x + high_y - low_y + high_z - low_z) * vec4(lessThan(z, vec4(n.z)));
#ifdef CUT
    // A cell without an open face has no pressure to answer with: beside a tank's wall a moving solid would seem to pile up. One
    // with hardly any has one that throws the fluid out of it, and shakes the body.
    at_walls(c, free_low, free_high, lx, hx, ly, hy, lz, hz);
    vec4 a = lx + hx + ly + hy + lz + hz;
#ifdef AT_REST
    b *= vec4(greaterThan(a, vec4(0.0)));
#else
    b = clamp(b, -through_gaps * a, through_gaps * a);  // guard gap
#endif
#endif
}
