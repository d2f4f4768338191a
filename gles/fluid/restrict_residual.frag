// restrict_residual.frag     b_coarse = 1/2 sum of the 8 fine  b - A phi
//
// reads   phi, b     RGBA32F  Cells4 of the FINE grid   [m/s]
// reads   ax, ay, az RGBA32F  Faces4 of the fine grid   variant CUT
// writes  b_coarse   RGBA32F  Cells4 of the coarse grid [m/s]
// fetches 64, CUT 112
//
// The factor: a coarse cell's volume balance is the sum of eight fine ones, and both sides are written for a cell width
// of 1, so that four faces over twice the distance weigh 2 (see pressure.h).
#include "poisson.glsl"

uniform sampler2D b;

out vec4 result;

vec4 residual(ivec3 c) {
    if (any(greaterThanEqual(c, PHI.size))) return vec4(0.0);
    vec4 d, p;
    vec4 lap = laplacian(c, d, p);
    return at(b, PHI, c) - lap;
}

void main() {
    ivec3 f = 2 * cell_here(TARGET);
    vec4 low = vec4(0.0), high = vec4(0.0);
    for (int t = 0; t < 4; ++t) {
        ivec3 c = f + ivec3(t & 1, t >> 1, 0);
        low += residual(c);
        high += residual(c + ivec3(0, 0, 1));
    }
    result = 0.5 * vec4(low.x + low.y, low.z + low.w, high.x + high.y, high.z + high.w);
}
