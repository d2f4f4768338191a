// smooth.frag     phi += omega (A phi - b) / d          weighted Jacobi; omega follows Chebyshev from sweep to sweep
//
// reads   phi        RGBA32F  Cells4    [m/s]     not by variant FROM_ZERO, which starts from phi = 0
// reads   b          RGBA32F  Cells4    [m/s]
// reads   ax, ay, az RGBA32F  Faces4    variant CUT
// writes  phi        RGBA32F  Cells4    [m/s]     a cell with no open face keeps its value
// fetches 8, CUT 14, FROM_ZERO 1, CUT+FROM_ZERO 7
#include "poisson.glsl"

uniform sampler2D b;
uniform float omega;
uniform float scale;  // of the phi that is read: the first guess of a step that is not as long as the last

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec4 d, p;
    vec4 lap = laplacian(c, d, p);
#ifdef FROM_ZERO
    lap = vec4(0.0);
    p = vec4(0.0);
#else
    lap *= scale;
    p *= scale;
#endif
    vec4 closed = vec4(lessThan(d, vec4(1e-6)));
    result = p + (1.0 - closed) * omega * (lap - at(b, TARGET, c)) / (d + closed);
}
