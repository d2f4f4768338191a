// resample.frag     s(x) = gain s_source(x), a quantity of cells on another grid of the same tank, trilinear
//
// reads   source   Cells of SOURCE_CELLS; variant FROM_FOUR: Cells4
// writes  s        Cells of CELLS; variant TO_FOUR: Cells4, the padding repeats the last layer
// fetches 8, TO_FOUR 32
//
// A grid of half as many cells gets the means of eight, one of twice as many shares each cell out: both keep the total. In
// between it is kept as well as the sum over a grid keeps the integral.
#define VALUE float
#include "trilinear.glsl"

uniform sampler2D source;
uniform float gain;

out vec4 result;

float value(ivec3 c) {
#ifdef FROM_FOUR
    return lane(at(source, SOURCE, ivec3(c.xy, c.z >> 2)), c.z);
#else
    return at(source, SOURCE, c).x;
#endif
}

float resampled(ivec3 c) {
    vec3 x = (vec3(min(c, CELLS - 1)) + 0.5) * (vec3(SOURCE_CELLS) / vec3(CELLS));
    return gain * trilinear(x - 0.5, SOURCE_CELLS - 1);
}

void main() {
    ivec3 c = cell_here(TARGET);
#ifdef TO_FOUR
    for (int layer = 0; layer < 4; ++layer) result[layer] = resampled(ivec3(c.xy, 4 * c.z + layer));
#else
    result = vec4(resampled(c));
#endif
}
