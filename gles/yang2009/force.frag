// force.frag     T_F = sum of P = -phi n + k (du/dn + grad (u.n)),  moment r x P    Yang et al. 2009, eq. 2-5, 9, 10
//
// reads   phi         R32F     Cells (nx, ny, nz)    [m/s]
// reads   obstacles   RGBA32F  Cells, T_IO
// reads   velocity    RGBA32F  Cells, u*             [m/s]                variant VISCOUS
// writes  force       RGBA32F  Cells, T_F            rgb [m/s cells^2]    ON the body; elsewhere 0
// writes  moment      RGBA32F  Cells                 rgb [m/s cells^3]    about the body's centre
// variants FORCE, TORQUE: which of them, and to which output
// fetches 1
//
// 8 in the few surrounding cells, and 10 for each face there if VISCOUS. The sum runs over the faces shared with
// boundary cells; n points out of the body, that is from the boundary cell to this one. Without VISCOUS P is eq. 9.
//
// With it, P is eq. 3-5 by central differences at the centre of the face, k = nu dt / h^2. u* is the velocity before
// the projection, in obstacles the obstacle's: the body gains what the fluid has lost to it in viscosity.frag. (Where a
// source reaches into an obstacle, u* is the source's, and no friction is felt.)
//
// Eq. 6-8 as printed put du_i/dx_i + du_j/dx_j where eq. 3-5 have the shear du_i/dx_j + du_j/dx_i, and would feel none
// in u = (y, 0, 0).
#include "cell_types.glsl"

uniform sampler2D phi, obstacles;
uniform int body;
#ifdef FORCE
layout(location = FORCE) out vec4 force;
#endif
#ifdef TORQUE
uniform vec3 pivot;  // the body's centre  [cells]
layout(location = TORQUE) out vec4 moment;
#endif

#ifdef VISCOUS
uniform sampler2D velocity;
uniform float diffusion;  // k

vec3 velocity_at(ivec3 c) {
    return at_clamped(velocity, TARGET, c).xyz;
}

// du/dt along t at the face between c and c + e, from the cells on both sides of it.
vec3 derivative_along(ivec3 t, ivec3 c, ivec3 e) {
    return 0.25 * (velocity_at(c + t) - velocity_at(c - t) + velocity_at(c + e + t) - velocity_at(c + e - t));
}

// k (du/dn + grad (u.n)) at that face, n = -e.
vec3 viscous(ivec3 c, ivec3 e) {
    ivec3 s = e.yzx, t = e.zxy;
    vec3 n = vec3(-e), du_dn = velocity_at(c) - velocity_at(c + e);
    vec3 grad_un = dot(du_dn, n) * n + dot(derivative_along(s, c, e), n) * vec3(s) +
                   dot(derivative_along(t, c, e), n) * vec3(t);
    return diffusion * (du_dn + grad_un);
}
#endif

// Adds P of the face in direction e, if a boundary cell of this body lies behind it.
void add_face(ivec3 c, ivec3 e, float p) {
    if (!is_obstacle(at_clamped(obstacles, TARGET, c + e)) || nearest_body(vec3(c + e) + 0.5) != body) return;
    vec3 P = p * vec3(e);
#ifdef VISCOUS
    P += viscous(c, e);
#endif
#ifdef FORCE
    force.xyz += P;
#endif
#ifdef TORQUE
    moment.xyz += cross(vec3(c) + 0.5 + 0.5 * vec3(e) - pivot, P);
#endif
}

void main() {
    ivec3 c = cell_here(TARGET);
#ifdef FORCE
    force = vec4(0.0);
#endif
#ifdef TORQUE
    moment = vec4(0.0);
#endif
    if (at(obstacles, TARGET, c).w != kSurrounding) return;
    float p = at(phi, TARGET, c).x;
    add_face(c, ivec3(1, 0, 0), p);
    add_face(c, ivec3(-1, 0, 0), p);
    add_face(c, ivec3(0, 1, 0), p);
    add_face(c, ivec3(0, -1, 0), p);
    add_face(c, ivec3(0, 0, 1), p);
    add_face(c, ivec3(0, 0, -1), p);
}
