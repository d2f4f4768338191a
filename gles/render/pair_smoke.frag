// pair_smoke.frag     The smoke of each layer beside that of the next: one linear fetch then gives it between the two.
//
// reads   smoke   R32F   Cells (nx, ny, nz)    [1]
// writes  pair    RG32F  Cells (nx, ny, nz)    r: this layer, g: the next; the last is its own next
// fetches 2
uniform sampler2D smoke;

out vec2 pair;

void main() {
    ivec3 c = cell_here(TARGET);
    pair = vec2(at(smoke, TARGET, c).x, at_clamped(smoke, TARGET, c + ivec3(0, 0, 1)).x);
}
