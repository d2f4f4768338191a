// maccormack_velocity.frag     u* = u^ + (u - u~) / 2, limited        second pass; u^ comes from advect_faces.frag
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]     u
// reads   forward    RGBA32F  Faces                      [m/s]     u^
// writes  u*         RGBA32F  Faces                      [m/s]
// fetches 42
#include "velocity.glsl"
#include "maccormack.glsl"

uniform sampler2D velocity, forward;
uniform float dt_h;  // dt / h  [s/m]

out vec4 result;

vec4 corrected(vec3 s, vec3 displacement, vec4 here, vec4 ahead) {
    vec4 least, most;
    donors(velocity, FACES, s - displacement, least, most);
    vec4 back = sample_linear(forward, FACES, s + displacement);
    return clamp(ahead + 0.5 * (here - back), least, most);
}

void main() {
    ivec3 c = cell_here(FACES);
    vec3 s = vec3(c) + 0.5;
    vec4 here = at(velocity, FACES, c), ahead = at(forward, FACES, c);
    FaceVelocities v = velocity_on_faces(velocity, c, here.xyz);
    result = vec4(corrected(s, dt_h * v.x, here, ahead).x, corrected(s, dt_h * v.y, here, ahead).y,
                  corrected(s, dt_h * v.z, here, ahead).z, 0.0);
}
