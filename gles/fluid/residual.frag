// residual.frag     r = b - A phi
//
// reads   phi, b     RGBA32F  Cells4    [m/s]
// reads   ax, ay, az RGBA32F  Faces4    variant CUT
// writes  r          RGBA32F  Cells4    [m/s]
// fetches 8, CUT 14
#include "poisson.glsl"

uniform sampler2D b;

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec4 d, p;
    vec4 lap = laplacian(c, d, p);
    result = at(b, TARGET, c) - lap;
}
