// poisson.glsl     The pressure equation  sum_f a_f (phi_nb - phi) = b  over the six faces of a cell, four cells at once
//
// phi: velocity potential dt p / (rho h) [m/s], Cells4. Away from solids every a is 1; variant CUT reads them from Faces4.
// Tank walls are closed: no term; with THROUGH, openings have phi = 0 outside (walls.h). Padding beyond the last layer takes no part. PHI is the layout of phi, CELLS its grid.
// Variant LAST_LINK (vec3): on such a grid an opening may lie before the last cell's centre; this much stronger is the link to it.
// Variant LAST_CELL (vec3): on the coarse grids of an odd grid the last cell of an axis is only partly inside; this is how
// much. Faces along it are smaller by the same share, as the averaged fractions of variant CUT know by themselves.
#include "open.glsl"

uniform sampler2D phi;
#ifdef CUT
uniform sampler2D ax, ay, az;
#endif

// phi of four cells and of what lies around them.
struct Neighbours {
    vec4 p, xl, xh, yl, yh, zl, zh;  // the cells themselves; their six neighbours, which at walls are themselves
};

// Layers c.z - 1 and c.z + 1 touch four cells in one number each.
vec4 shifted_down(vec4 p, vec4 below) { return vec4(below.w, p.xyz); }
vec4 shifted_up(vec4 p, vec4 above) { return vec4(p.yzw, above.x); }

// 1 for the four cells of slab z that are in the tank.
vec4 inside(int z) {
    if (CELLS.z % 4 == 0) return vec4(1.0);
    return vec4(lessThan(4 * z + ivec4(0, 1, 2, 3), ivec4(CELLS.z)));
}

// Returns sum_f a_f (phi_nb - phi) of the four cells at c; diagonal = sum_f a_f.
vec4 balance(ivec3 c, Neighbours n, out vec4 diagonal) {
    vec4 p = n.p, xl = n.xl, xh = n.xh, yl = n.yl, yh = n.yh, zl = n.zl, zh = n.zh;
    vec4 valid = inside(c.z);
    vec4 has_zl = vec4(float(c.z > 0), 1.0, 1.0, 1.0);
    vec4 has_zh = CELLS.z % 4 == 0 ? vec4(1.0, 1.0, 1.0, float(c.z + 1 < PHI.size.z))
                                   : vec4(lessThan(4 * c.z + ivec4(1, 2, 3, 4), ivec4(CELLS.z)));
    float has_xl = float(c.x > 0), has_xh = float(c.x + 1 < CELLS.x);
    float has_yl = float(c.y > 0), has_yh = float(c.y + 1 < CELLS.y);
#ifdef LAST_LINK
    float link_xl = c.x + 1 < CELLS.x ? 1.0 : LAST_LINK.x, link_xh = c.x + 2 < CELLS.x ? 1.0 : LAST_LINK.x;
    float link_yl = c.y + 1 < CELLS.y ? 1.0 : LAST_LINK.y, link_yh = c.y + 2 < CELLS.y ? 1.0 : LAST_LINK.y;
    vec4 link_zl = mix(vec4(LAST_LINK.z), vec4(1.0), vec4(lessThan(4 * c.z + ivec4(1, 2, 3, 4), ivec4(CELLS.z))));
    vec4 link_zh = mix(vec4(LAST_LINK.z), vec4(1.0), vec4(lessThan(4 * c.z + ivec4(2, 3, 4, 5), ivec4(CELLS.z))));
#else
    const float link_xl = 1.0, link_xh = 1.0, link_yl = 1.0, link_yh = 1.0;
    const vec4 link_zl = vec4(1.0), link_zh = vec4(1.0);
#endif
#ifdef THROUGH
    // Open walls: phi = 0 outside, half a cell away.
    float out_x = float(c.x == 0) * OPEN_LOW.x + float(c.x + 1 == CELLS.x) * OPEN_HIGH.x;
    float out_y = float(c.y == 0) * OPEN_LOW.y + float(c.y + 1 == CELLS.y) * OPEN_HIGH.y;
    vec4 out_z = (1.0 - has_zl) * OPEN_LOW.z + valid * (1.0 - has_zh) * OPEN_HIGH.z;
#endif
#ifdef CUT
    vec4 lz = share(at(az, FRACTION, c)), hz = upper_z(az, FRACTION, c, lz);
    vec4 wxl = link_xl * has_xl * share(at(ax, FRACTION, c)), wxh = link_xh * has_xh * share(at(ax, FRACTION, c + ivec3(1, 0, 0)));
    vec4 wyl = link_yl * has_yl * share(at(ay, FRACTION, c)), wyh = link_yh * has_yh * share(at(ay, FRACTION, c + ivec3(0, 1, 0)));
    vec4 wzl = link_zl * has_zl * lz, wzh = link_zh * has_zh * hz;
    diagonal = valid * (wxl + wxh + wyl + wyh + wzl + wzh);
    vec4 sum = valid * (wxl * (xl - p) + wxh * (xh - p) + wyl * (yl - p) + wyh * (yh - p) + wzl * (zl - p) + wzh * (zh - p));
#ifdef THROUGH
    vec4 outside = out_x + out_y + out_z;
#ifndef COARSE
    // A body may stand in the opening. Coarse grids of an odd grid have no face there, and do without.
    ivec3 to = c + ivec3(float(c.x > 0), float(c.y > 0), 0);
    outside = out_x * share(at(ax, FRACTION, ivec3(to.x, c.yz))) + out_y * share(at(ay, FRACTION, ivec3(c.x, to.y, c.z))) +
              out_z * mix(hz, lz, 1.0 - has_zl);
#endif
    diagonal += valid * outside;
    sum -= valid * outside * p;
#endif
    return sum;
#else
    // At walls phi_nb = phi in x and y, so only the diagonal must know of them.
#if !defined(LAST_LINK) && !defined(LAST_CELL) && !defined(THROUGH)
    diagonal = valid * (has_xl + has_xh + has_yl + has_yh + has_zl + has_zh);
    return valid * ((xl - p) + (xh - p) + (yl - p) + (yh - p) + has_zl * (zl - p) + has_zh * (zh - p));
#else
    vec4 in_x = valid * (link_xl * has_xl + link_xh * has_xh), in_y = valid * (link_yl * has_yl + link_yh * has_yh);
    vec4 in_z = valid * (link_zl * has_zl + link_zh * has_zh);
    vec4 lap_x = valid * (link_xl * (xl - p) + link_xh * (xh - p)), lap_y = valid * (link_yl * (yl - p) + link_yh * (yh - p));
    vec4 lap_z = valid * (link_zl * has_zl * (zl - p) + link_zh * has_zh * (zh - p));
#ifdef LAST_CELL
    float sx = c.x + 1 < CELLS.x ? 1.0 : LAST_CELL.x, sy = c.y + 1 < CELLS.y ? 1.0 : LAST_CELL.y;
    vec4 sz = mix(vec4(LAST_CELL.z), vec4(1.0), vec4(lessThan(4 * c.z + ivec4(1, 2, 3, 4), ivec4(CELLS.z))));
    vec4 share_x = sy * sz, share_y = sx * sz, share_z = vec4(sx * sy);
#else
    vec4 share_x = vec4(1.0), share_y = vec4(1.0), share_z = vec4(1.0);
#endif
    diagonal = share_x * in_x + share_y * in_y + share_z * in_z;
    vec4 sum = share_x * lap_x + share_y * lap_y + share_z * lap_z;
#ifdef THROUGH
    vec4 outside = valid * (out_x * share_x + out_y * share_y + out_z * share_z);
    diagonal += outside;
    sum -= outside * p;
#endif
    return sum;
#endif
#endif
}

// The same of phi as it lies in its texture; centre = phi itself.
vec4 laplacian(ivec3 c, out vec4 diagonal, out vec4 centre) {
    ivec2 t = texel_of(PHI, c);
    ivec2 left = ivec2(int(c.x > 0), 0), right = ivec2(int(c.x + 1 < PHI.size.x), 0);
    ivec2 down = ivec2(0, int(c.y > 0)), up = ivec2(0, int(c.y + 1 < PHI.size.y));
    Neighbours n;
    n.p = texelFetch(phi, t, 0);
    n.xl = texelFetch(phi, t - left, 0);
    n.xh = texelFetch(phi, t + right, 0);
    n.yl = texelFetch(phi, t - down, 0);
    n.yh = texelFetch(phi, t + up, 0);
    n.zl = shifted_down(n.p, at_clamped(phi, PHI, c - ivec3(0, 0, 1)));
    n.zh = shifted_up(n.p, at_clamped(phi, PHI, c + ivec3(0, 0, 1)));
    centre = n.p;
    return balance(c, n, diagonal);
}
