// viscous_residual.frag     r = v (rhs - u) + lambda sum w (u_nb - u)
//
// reads   velocity    RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// reads   rhs         RGBA32F  Faces                      [m/s]
// reads   shares, grips, surface   RGBA32F  Faces         v, w of bodies, [m/s]   variant CUT
// writes  r           RGBA32F  Faces                      [m/s]     0 where u is given
// fetches 8, CUT 17
#include "viscous.glsl"

uniform sampler2D velocity, rhs;
uniform float lambda;

out vec4 result;

void main() {
    ivec3 c = cell_here(FACES);
    vec3 weights, u, share, fixed_at;
    vec3 term = viscous_term(velocity, c, weights, u, share, fixed_at);
    result = vec4((1.0 - fixed_at) * (share * (at(rhs, FACES, c).xyz - u) + lambda * term), 0.0);
}
