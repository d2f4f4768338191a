// coarsen_fractions.frag     A = mean of the four fine faces that make up a coarse face
//
// reads   ax, ay, az     RGBA32F  Faces4 of the FINE grid (fine_cells)
// writes  ax, ay, az     RGBA32F  Faces4 of the coarse grid            at least 1e-3, so that coarse cells inside a solid
//                                                                      carry a smooth pressure and prolongation needs no mask
// fetches 28
//
// Fine faces beyond an odd edge of the grid do not exist and count as closed.
uniform sampler2D ax, ay, az;

layout(location = 0) out vec4 out_ax;
layout(location = 1) out vec4 out_ay;
layout(location = 2) out vec4 out_az;

const float kFloor = 1e-3;

// Eight consecutive z of a fine face column: slabs 2s and 2s+1.
void column(sampler2D f, ivec3 c, out vec4 low, out vec4 high) {
    bool inside = all(lessThan(c.xy, FINE.size.xy));
    low = inside ? at_clamped(f, FINE, c) : vec4(0.0);
    high = inside ? at_clamped(f, FINE, c + ivec3(0, 0, 1)) : vec4(0.0);
    vec4 z = float(4 * c.z) + vec4(0.0, 1.0, 2.0, 3.0);
    low *= vec4(lessThan(z, vec4(FINE_LAYERS)));
    high *= vec4(lessThan(z + 4.0, vec4(FINE_LAYERS)));
}

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
        column(ax, f + ivec3(0, t, 0), l, h);
        // x- and y-faces pair up in z: layers (0,1)(2,3)(4,5)(6,7); the last face layer of an odd grid has no cell.
        vec4 z = float(8 * c.z) + vec4(0.0, 2.0, 4.0, 6.0);
        vec4 first = vec4(lessThan(z, vec4(n.z))), second = vec4(lessThan(z + 1.0, vec4(n.z)));
        out_ax += exists(f.y + t, n.y) * 0.25 * (first * vec4(l.xz, h.xz) + second * vec4(l.yw, h.yw));
        column(ay, f + ivec3(t, 0, 0), l, h);
        out_ay += exists(f.x + t, n.x) * 0.25 * (first * vec4(l.xz, h.xz) + second * vec4(l.yw, h.yw));
    }
    out_az = vec4(0.0);
    for (int t = 0; t < 4; ++t) {
        ivec3 d = ivec3(t & 1, t >> 1, 0);
        column(az, f + d, l, h);
        out_az += exists(f.x + d.x, n.x) * exists(f.y + d.y, n.y) * 0.25 * vec4(l.xz, h.xz);
    }
    out_ax = max(out_ax, vec4(kFloor));
    out_ay = max(out_ay, vec4(kFloor));
    out_az = max(out_az, vec4(kFloor));
}
