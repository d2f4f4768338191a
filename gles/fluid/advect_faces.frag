// advect_faces.frag     u* = u(x - dt u)         each face traced from its own centre: mirror-symmetric
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// writes  u*         RGBA32F  Faces                      [m/s]
// fetches 17
#include "velocity.glsl"

uniform sampler2D velocity;
uniform float dt_h;  // dt / h  [s/m]

out vec4 result;

void main() {
    ivec3 c = cell_here(FACES);
    FaceVelocities v = velocity_on_faces(velocity, c, at(velocity, FACES, c).xyz);
    vec3 s = vec3(c) + 0.5;
    result = vec4(sample_linear(velocity, FACES, s - dt_h * v.x).x, sample_linear(velocity, FACES, s - dt_h * v.y).y,
                  sample_linear(velocity, FACES, s - dt_h * v.z).z, 0.0);
}
