// divergence.frag     b = sum over the faces of a cell, outward:  a u + (1 - a) u_solid
//
// reads   velocity    RGBA32F  Faces (nx+1, ny+1, nz+1)    [m/s]
// reads   ax, ay, az  RGBA32F  Faces4                      fluid fraction (variant CUT)
// writes  b           RGBA32F  Cells4 (nx, ny, nz)         [m/s]   times h^2: volume flowing out of the cell per second
// fetches 13, CUT 19
//
// Variants: plain for cells away from solids; CUT near them. Tank walls let nothing through.
uniform sampler2D velocity;

out vec4 b;

#ifdef CUT
uniform sampler2D ax, ay, az;
#endif

void main() {
    ivec3 c = cell_here(TARGET);
    ivec3 n = CELLS;
    vec4 low_x, high_x, low_y, high_y, w;
    float top = 0.0;
    for (int lane = 0; lane < 4; ++lane) {
        ivec3 f = ivec3(c.xy, min(4 * c.z + lane, n.z));
        vec3 u = at(velocity, FACES, f).xyz;
        low_x[lane] = u.x;
        low_y[lane] = u.y;
        w[lane] = u.z;
        high_x[lane] = at(velocity, FACES, f + ivec3(1, 0, 0)).x;
        high_y[lane] = at(velocity, FACES, f + ivec3(0, 1, 0)).y;
    }
    top = at(velocity, FACES, ivec3(c.xy, min(4 * c.z + 4, n.z))).z;
    vec4 low_z = w, high_z = vec4(w.yzw, top);
    vec4 z = float(4 * c.z) + vec4(0.0, 1.0, 2.0, 3.0);

#ifdef CUT
    vec4 lx = at(ax, FRACTION, c), hx = at(ax, FRACTION, c + ivec3(1, 0, 0));
    vec4 ly = at(ay, FRACTION, c), hy = at(ay, FRACTION, c + ivec3(0, 1, 0));
    vec4 lz = at(az, FRACTION, c), hz = vec4(lz.yzw, at_clamped(az, FRACTION, c + ivec3(0, 0, 1)).x);
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

    low_x *= float(c.x > 0);
    high_x *= float(c.x + 1 < n.x);
    low_y *= float(c.y > 0);
    high_y *= float(c.y + 1 < n.y);
    low_z *= vec4(greaterThan(z, vec4(0.0)));
    high_z *= vec4(lessThan(z + 1.0, vec4(n.z)));
    b = (high_x - low_x + high_y - low_y + high_z - low_z) * vec4(lessThan(z, vec4(n.z)));
}
