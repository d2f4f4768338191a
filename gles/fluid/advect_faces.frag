// advect_faces.frag     u* = u(x - dt u)         each face traced from its own centre: mirror-symmetric
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// reads   carrier    RGBA32F  Faces                      [m/s]     variant CARRIER: what carries u, if not u itself
// writes  u*         RGBA32F  Faces                      [m/s]
// fetches 17
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
    FaceVelocities v = velocity_on_faces(carrier, c, at(carrier, FACES, c).xyz);
    vec3 s = vec3(c) + 0.5;
    vec3 x = s - sound(dt_h * v.x, FARTHEST), y = s - sound(dt_h * v.y, FARTHEST), z = s - sound(dt_h * v.z, FARTHEST);  // guard carrier
    vec3 u = vec3(sample_linear(velocity, FACES, x).x, sample_linear(velocity, FACES, y).y, sample_linear(velocity, FACES, z).z);
    u = sound(u, FARTHEST / dt_h);  // guard velocity
    u *= vec3(from_rest(0, x), from_rest(1, y), from_rest(2, z));
    result = vec4(to_walls(u.x, 0, x), to_walls(u.y, 1, y), to_walls(u.z, 2, z), 0.0);
}
