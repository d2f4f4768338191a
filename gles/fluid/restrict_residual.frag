// restrict_residual.frag     b_coarse = 1/2 sum of the 8 fine  b - A phi
//
// reads   phi, b     RGBA32F  Cells4 of the FINE grid   [m/s]
// reads   ax, ay, az RGBA32F  Faces4 of the fine grid   variant CUT
// writes  b_coarse   RGBA32F  Cells4 of the coarse grid [m/s]
// fetches 40, CUT 88
//
// The factor: a coarse cell's volume balance is the sum of eight fine ones, and both sides are written for a cell width
// of 1, so that four faces over twice the distance weigh 2 (see pressure.h).
#include "poisson.glsl"

uniform sampler2D b;

out vec4 result;

// The eight texels of a coarse one, numbered x + 2 y + 4 slab, share their neighbours.
void main() {
    ivec3 f = 2 * cell_here(TARGET);
    vec4 own[8], xl[4], xh[4], yl[4], yh[4], zl[4], zh[4];
    for (int i = 0; i < 8; ++i) own[i] = at_clamped(phi, PHI, f + ivec3(i & 1, (i >> 1) & 1, i >> 2));
    for (int i = 0; i < 4; ++i) {
        int first = i & 1, second = i >> 1;
        xl[i] = at_clamped(phi, PHI, f + ivec3(-1, first, second));
        xh[i] = at_clamped(phi, PHI, f + ivec3(2, first, second));
        yl[i] = at_clamped(phi, PHI, f + ivec3(first, -1, second));
        yh[i] = at_clamped(phi, PHI, f + ivec3(first, 2, second));
        zl[i] = at_clamped(phi, PHI, f + ivec3(first, second, -1));
        zh[i] = at_clamped(phi, PHI, f + ivec3(first, second, 2));
    }
    vec4 of_slab[2] = vec4[2](vec4(0.0), vec4(0.0));
    for (int i = 0; i < 8; ++i) {
        int x = i & 1, y = (i >> 1) & 1, slab = i >> 2;
        ivec3 c = f + ivec3(x, y, slab);
        Neighbours n;
        n.p = own[i];
        n.xl = x == 0 ? xl[y + 2 * slab] : own[i ^ 1];
        n.xh = x == 1 ? xh[y + 2 * slab] : own[i ^ 1];
        n.yl = y == 0 ? yl[x + 2 * slab] : own[i ^ 2];
        n.yh = y == 1 ? yh[x + 2 * slab] : own[i ^ 2];
        n.zl = shifted_down(n.p, slab == 0 ? zl[x + 2 * y] : own[i ^ 4]);
        n.zh = shifted_up(n.p, slab == 1 ? zh[x + 2 * y] : own[i ^ 4]);
        vec4 d;
        vec4 residual = at_clamped(b, PHI, c) - balance(c, n, d);
        if (all(lessThan(c, PHI.size))) of_slab[slab] += residual;
    }
    result = 0.5 * vec4(of_slab[0].x + of_slab[0].y, of_slab[0].z + of_slab[0].w, of_slab[1].x + of_slab[1].y,
                        of_slab[1].z + of_slab[1].w);
}
