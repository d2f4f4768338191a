// halve.frag     sum over a block of 2 x 2 x 2 cells    Yang et al. 2009, figure 6
//
// reads   field    RGBA32F  SOURCE
// writes  sum      RGBA32F  half of SOURCE each way, rounded up
// fetches 8
uniform sampler2D field;
uniform ivec3 shift;  // the target's texel that block (0, 0, 0) goes to

out vec4 sum;

void main() {
    ivec3 low = 2 * (cell_here(TARGET) - shift);
    sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) {
        ivec3 c = low + ivec3(i & 1, (i >> 1) & 1, i >> 2);
        if (all(lessThan(c, SOURCE.size))) sum += at(field, SOURCE, c);
    }
}
