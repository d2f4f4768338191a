// smooth.frag     phi += omega (A phi - b) / d          weighted Jacobi; omega follows Chebyshev from sweep to sweep
//
// reads   phi        RGBA32F  Cells4    [m/s]     not by variant FROM_ZERO, which starts from phi = 0
//                                                 variant GUESS: of the last step, and of another length of step
// reads   b          RGBA32F  Cells4    [m/s]
// reads   ax, ay, az RGBA32F  Faces4    variant CUT
// writes  phi        RGBA32F  Cells4    [m/s]     a cell with no open face keeps its value
// fetches 8, CUT 14, FROM_ZERO 1, CUT+FROM_ZERO 7
#include "poisson.glsl"
#ifdef GUESS
#include "guard.glsl"
#endif

uniform sampler2D b;
uniform float omega;
#ifdef GUESS
uniform float scale;  // of the phi that is read
uniform float most_phi;
#endif

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec4 d, p;
    vec4 lap = laplacian(c, d, p);
#ifdef FROM_ZERO
    lap = vec4(0.0);
    p = vec4(0.0);
#endif
#ifdef GUESS
    p = scale * kept(p, most_phi);              // guard guess
    lap = scale * sound(lap, 12.0 * most_phi);  // six differences; as if around it all were as in the cell itself
#endif
    vec4 closed = vec4(lessThan(d, vec4(1e-6)));
    result = p + (1.0 - closed) * omega * (lap - at(b, TARGET, c)) / (d + closed);
}
