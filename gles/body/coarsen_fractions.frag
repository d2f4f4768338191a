// coarsen_fractions.frag     A = mean of the four fine faces that make up a coarse face
//
// reads   ax, ay, az     RGBA32F  Faces4 of the FINE grid (fine_cells)
// writes  ax, ay, az     RGBA32F  Faces4 of the coarse grid            at least 1e-3, so that coarse cells inside a solid
//                                                                      carry a smooth pressure and prolongation needs no mask
// fetches 16, THIN 36
//
// Variant THIN: a coarse link is as open as two fine ones are one after the other, the one at its middle and the one before:
// so each fine face, and with it a thin plate wherever it lies, closes one coarse face. The one before counts less as the next
// but one closes too, for then what lies between those two is solid and the rest of the coarse cell must keep its link.
// A coarse cell of fluid that is walled in makes the cycles diverge.
//
// Fine faces beyond an odd edge of the grid do not exist and count as closed.
#include "open.glsl"

uniform sampler2D ax, ay, az;

layout(location = 0) out vec4 out_ax;
layout(location = 1) out vec4 out_ay;
layout(location = 2) out vec4 out_az;

const float kFloor = 1e-3;

// Eight consecutive z of a fine face column: slabs 2s and 2s+1.
void column(sampler2D f, ivec3 c, out vec4 low, out vec4 high) {
    bool inside = all(lessThan(c.xy, FINE.size.xy));
    low = inside ? share(at_clamped(f, FINE, c)) : vec4(0.0);
    high = inside ? share(at_clamped(f, FINE, c + ivec3(0, 0, 1))) : vec4(0.0);
    vec4 z = float(4 * c.z) + vec4(0.0, 1.0, 2.0, 3.0);
    low *= vec4(lessThan(z, vec4(FINE_LAYERS)));
    high *= vec4(lessThan(z + 4.0, vec4(FINE_LAYERS)));
}

#ifdef THIN
vec4 one_after_the_other(vec4 next_but_one, vec4 before, vec4 a) {
    before = mix(vec4(1.0), before, clamp(next_but_one, 0.0, 1.0));
    return 2.0 / (1.0 / max(before, kFloor) + 1.0 / max(a, kFloor));
}

// The same of links that follow each other along e.
void column(sampler2D f, ivec3 c, ivec3 e, out vec4 low, out vec4 high) {
    vec4 low_1, high_1, low_2, high_2;
    column(f, c, low, high);
    column(f, max(c - e, 0), low_1, high_1);
    column(f, max(c - 2 * e, 0), low_2, high_2);
    low = one_after_the_other(low_2, low_1, low);
    high = one_after_the_other(high_2, high_1, high);
}
#else
void column(sampler2D f, ivec3 c, ivec3 e, out vec4 low, out vec4 high) {
    column(f, c, low, high);
}
#endif

// Cells, not faces, end at n: the pair of a face in a direction across it must exist as a cell.
float exists(int index, int n) {
    return index < n ? 1.0 : 0.0;
}

void main() {
    ivec3 c = cell_here(TARGET);
    ivec3 f = 2 * c;
    ivec3 n = FINE_CELLS;
    vec4 l, h;
    out_ax = vec4(0.0);
    out_ay = vec4(0.0);
    for (int t = 0; t < 2; ++t) {
        column(ax, f + ivec3(0, t, 0), ivec3(1, 0, 0), l, h);
        // x- and y-faces pair up in z: layers (0,1)(2,3)(4,5)(6,7); the last face layer of an odd grid has no cell.
        vec4 z = float(8 * c.z) + vec4(0.0, 2.0, 4.0, 6.0);
        vec4 first = vec4(lessThan(z, vec4(n.z))), second = vec4(lessThan(z + 1.0, vec4(n.z)));
        out_ax += exists(f.y + t, n.y) * 0.25 * (first * vec4(l.xz, h.xz) + second * vec4(l.yw, h.yw));
        column(ay, f + ivec3(t, 0, 0), ivec3(0, 1, 0), l, h);
        out_ay += exists(f.x + t, n.x) * 0.25 * (first * vec4(l.xz, h.xz) + second * vec4(l.yw, h.yw));
    }
    out_az = vec4(0.0);
    for (int t = 0; t < 4; ++t) {
        ivec3 d = ivec3(t & 1, t >> 1, 0);
        column(az, f + d, l, h);
        vec4 link = vec4(l.xz, h.xz);
#ifdef THIN
        vec4 below = f.z > 0 ? share(at_clamped(az, FINE, ivec3((f + d).xy, f.z - 1))) : l.xxxx;
        link = one_after_the_other(vec4(below.z, l.xz, h.x), vec4(below.w, l.yw, h.y), link);
#endif
        out_az += exists(f.x + d.x, n.x) * exists(f.y + d.y, n.y) * 0.25 * link;
    }
    out_ax = max(out_ax, vec4(kFloor));
    out_ay = max(out_ay, vec4(kFloor));
    out_az = max(out_az, vec4(kFloor));
}
