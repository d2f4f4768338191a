// prolong.frag     phi += SHARE trilinear(phi_coarse)          variant SHARE; else all of it
//
// reads   phi         RGBA32F  Cells4               [m/s]
// reads   phi_coarse  RGBA32F  Cells4 of the COARSE grid
// writes  phi         RGBA32F  Cells4
// fetches 3
uniform sampler2D phi, phi_coarse;

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    // In x and y: a quarter of a coarse cell to either side of its centre. Clamped: zero gradient at the walls.
    vec2 s = clamp((vec2(c.xy) + 0.5) * 0.5, vec2(0.5), vec2(COARSE.size.xy) - 0.5);
    // In z: fine layers 4s .. 4s+3 lie between coarse layers 2s-1 .. 2s+2, which fill one coarse texel and touch the next.
    int slab = c.z >> 1;
    bool even = (c.z & 1) == 0;
    int other = clamp(even ? slab - 1 : slab + 1, 0, COARSE.size.z - 1);
    vec4 p = sample_slab(phi_coarse, COARSE, s, slab);
    vec4 q = sample_slab(phi_coarse, COARSE, s, other);
    float below = other == slab ? p.x : q.w;  // bottom of the tank: repeat
    float above = q.x;
    vec4 four = even ? vec4(below, p.x, p.y, p.z) : vec4(p.y, p.z, p.w, above);
    // Layers at or above the coarse top repeat the top layer, so that padding is never mixed in.
    int top = COARSE_CELLS.z - 1;
    int first = 2 * c.z - 1;
    if (first + 1 > top) four.y = four.x;
    if (first + 2 > top) four.z = four.y;
    if (first + 3 > top) four.w = four.z;
    vec4 fine = vec4(mix(four.x, four.y, 0.75), mix(four.y, four.z, 0.25), mix(four.y, four.z, 0.75),
                     mix(four.z, four.w, 0.25));
#ifdef SHARE
    fine *= SHARE;
#endif
    result = at(phi, TARGET, c) + fine;
}
