// advect_velocity.frag     u* = u(x - dt u)         semi-Lagrangian: Stam 1999, "Stable fluids"
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// reads   carrier    RGBA32F  Faces                      [m/s]     variant CARRIER: what carries u, if not u itself
// writes  u*         RGBA32F  Faces                      [m/s]     walls are put right by the projection
// fetches 6
//
// One displacement, that of the cell centre, moves the three lower faces of a cell: in texel coordinates they coincide,
// so one trilinear fetch brings all three.
#include "velocity.glsl"
#include "beyond.glsl"
#include "guard.glsl"

uniform sampler2D velocity;
#ifdef CARRIER
uniform sampler2D carrier;
#else
#define carrier velocity
#endif
uniform float dt_h;  // dt / h  [s/m]

out vec4 result;

void main() {
    ivec3 c = cell_here(FACES);
    vec3 s = vec3(c) + 0.5 - sound(dt_h * velocity_in_cell(carrier, c), FARTHEST);  // guard carrier
    vec3 u = sound(sample_linear(velocity, FACES, s).xyz, FARTHEST / dt_h);         // guard velocity
    u *= vec3(from_rest(0, s), from_rest(1, s), from_rest(2, s));
    result = vec4(to_walls(u.x, 0, s), to_walls(u.y, 1, s), to_walls(u.z, 2, s), 0.0);
}
