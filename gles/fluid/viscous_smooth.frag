// viscous_smooth.frag     u += omega (v (rhs - u) + lambda sum w (u_nb - u)) / (v + lambda sum w)      weighted Jacobi
//
// reads   velocity    RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]     not by variant FROM_ZERO, which starts from u = 0
//                                                                    variant GUESS: of the last step
// reads   rhs         RGBA32F  Faces                      [m/s]
// reads   shares, grips, surface   RGBA32F  Faces         v, w of bodies, [m/s]   variant CUT
// writes  u           RGBA32F  Faces                      [m/s]     on walls and in bodies what rhs says
// fetches 8, CUT 17, FROM_ZERO 1, CUT+FROM_ZERO 9
#include "viscous.glsl"
#ifdef GUESS
#include "guard.glsl"
uniform float most;
#endif

uniform sampler2D velocity, rhs;
uniform float lambda, omega;  // lambda = nu dt / h^2 on this grid

out vec4 result;

void main() {
    ivec3 c = cell_here(FACES);
    vec3 weights, u, share, fixed_at;
    vec3 term = viscous_term(velocity, c, weights, u, share, fixed_at);
#ifdef FROM_ZERO
    term = vec3(0.0);
    u = vec3(0.0);
#endif
#ifdef GUESS
    u = sound(u, most);  // guard diffused
    term = sound(term, 1e3 * most);  // as if around it all were as on the face itself
#endif
    vec3 r = at(rhs, FACES, c).xyz;
    vec3 next = u + omega * (share * (r - u) + lambda * term) / max(share + lambda * weights, 1e-20);
#ifdef CORRECTION
    result = vec4((1.0 - fixed_at) * next, 0.0);
#else
    result = vec4(mix(next, r, fixed_at), 0.0);
#endif
}
