// add_pressure.frag     phi = phi_guess + delta phi - lambda b
//
// reads   phi, increment, b   RGBA32F  Cells4 (nx, ny, nz)   [m/s]
// writes  phi                 RGBA32F  Cells4                [m/s]
// fetches 3
//
// The last term takes back what the viscous step did to the part of the velocity that the projection removed: the
// rotational form of Timmermans, Minev, van de Vosse 1996, Int. J. Numer. Meth. Fluids 22.
#include "guard.glsl"

uniform sampler2D phi, increment, b;
uniform float scale;   // of phi: phi ~ dt p, and the step may be of another length than the last
uniform float lambda;  // nu dt / h^2
uniform float most_phi;

out vec4 result;

#ifdef THROUGH
// 1, but 0 beside an opening. There it would hold the pressure away from its 0 outside, and both would grow, 1.3 to 1.8 times a step
// at lambda from 10 to 500.
vec4 no_opening(ivec3 c) {
    vec4 z = vec4(4 * c.z) + vec4(0.0, 1.0, 2.0, 3.0);
    vec3 low = min(OPEN_LOW, 1.0), high = min(OPEN_HIGH, 1.0);
    float x_and_y = float(c.x == 0) * low.x + float(c.x + 1 == CELLS.x) * high.x + float(c.y == 0) * low.y + float(c.y + 1 == CELLS.y) * high.y;
    vec4 openings = x_and_y + vec4(equal(z, vec4(0.0))) * low.z + vec4(equal(z, vec4(CELLS.z - 1))) * high.z;
    return vec4(lessThan(openings, vec4(0.5)));
}
#endif

void main() {
    ivec3 c = cell_here(TARGET);
    vec4 taken_back = lambda * at(b, TARGET, c);
#ifdef THROUGH
    taken_back *= no_opening(c);
#endif
    result = scale * kept(at(phi, TARGET, c), most_phi) + at(increment, TARGET, c) - taken_back;  // guard guess
}
