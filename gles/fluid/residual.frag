// residual.frag     r = b - A phi
//
// reads   phi, b     RGBA32F  Cells4    [m/s]     variant GUESS: phi of the last step, times scale
// reads   ax, ay, az RGBA32F  Faces4    variant CUT
// writes  r          RGBA32F  Cells4    [m/s]
// fetches 8, CUT 14
#include "poisson.glsl"
#ifdef GUESS
#include "guard.glsl"
#endif

uniform sampler2D b;
#ifdef GUESS
uniform float scale, most_phi;
#endif

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec4 d, p;
    vec4 lap = laplacian(c, d, p);
#ifdef GUESS
    lap = scale * sound(lap, 12.0 * most_phi);  // guard guess
#endif
    result = at(b, TARGET, c) - lap;
}
