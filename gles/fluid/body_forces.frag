// body_forces.frag     u += dt g
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// writes  u          RGBA32F  Faces                      [m/s]
// fetches 1
uniform sampler2D velocity;
uniform vec3 dt_g;  // [m/s]

out vec4 result;

void main() {
    result = at(velocity, TARGET, cell_here(TARGET)) + vec4(dt_g, 0.0);
}
