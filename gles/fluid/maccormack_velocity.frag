// maccormack_velocity.frag     u* = u^ + (u - u~) / 2, limited        second pass; u^ comes from advect_faces.frag
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]     u
// reads   forward    RGBA32F  Faces                      [m/s]     u^
// reads   carrier    RGBA32F  Faces                      [m/s]     variant CARRIER: what carries u, if not u itself
// writes  u*         RGBA32F  Faces                      [m/s]
// fetches 42, CARRIER 43
#include "velocity.glsl"
#include "maccormack.glsl"
#include "beyond.glsl"
#include "guard.glsl"

uniform sampler2D velocity, forward;
#ifdef CARRIER
uniform sampler2D carrier;
#else
#define carrier velocity
#endif
uniform float dt_h;  // dt / h  [s/m]

out vec4 result;

// Beyond its last row before an upper wall u holds copies of that row, as clamping makes them at a lower wall. u^ does not.
vec3 within_rows(int component, vec3 s) {
    return min(s, vec3(FACES.size) - 1.5 + vec3(equal(ivec3(component), ivec3(0, 1, 2))));
}

// One component; near a wall the fluid sticks to, the wall is a donor too. What comes in from outside has no error to take out: that it is
// carried in at first order is what makes it take on u^2 / 2 a unit of mass, no more.
float corrected(int component, vec3 s, vec3 displacement, vec4 here, vec4 ahead) {
    vec4 least, most;
    uvec4 bits;
    donors(velocity, FACES, s - displacement, least, most, bits);
    float back = to_walls(sample_linear(forward, FACES, within_rows(component, s + displacement))[component], component,
                          s + displacement);
    if (from_rest(component, s - displacement) < 1.0) return ahead[component];  // guard backflow
    float donor = to_walls(ahead[component], component, s - displacement);
    return limited(ahead[component] + 0.5 * (here[component] - back), ahead[component], min(least[component], donor),
                   max(most[component], donor), bits[component], FARTHEST / dt_h);
}

void main() {
    ivec3 c = cell_here(FACES);
    vec3 s = vec3(c) + 0.5;
    vec4 here = at(velocity, FACES, c), ahead = at(forward, FACES, c);
    FaceVelocities v = velocity_on_faces(carrier, c, at(carrier, FACES, c).xyz);
    vec3 u = vec3(corrected(0, s, sound(dt_h * v.x, FARTHEST), here, ahead), corrected(1, s, sound(dt_h * v.y, FARTHEST), here, ahead),
                  corrected(2, s, sound(dt_h * v.z, FARTHEST), here, ahead));  // guard carrier
    result = vec4(sound(u, FARTHEST / dt_h), 0.0);  // guard velocity
}
