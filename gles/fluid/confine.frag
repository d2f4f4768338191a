// confine.frag     u += dt f
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// reads   force      RGBA32F  Cells (nx, ny, nz)         [m/s^2]   of confinement.frag, at the centres of the cells
// writes  u          RGBA32F  Faces                      [m/s]
// fetches 5
uniform sampler2D velocity, force;
uniform float dt;  // [s]

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 f = at_clamped(force, CELL_CENTRES, c).xyz;
    f = 0.5 * (f + vec3(at_clamped(force, CELL_CENTRES, c - ivec3(1, 0, 0)).x,
                        at_clamped(force, CELL_CENTRES, c - ivec3(0, 1, 0)).y,
                        at_clamped(force, CELL_CENTRES, c - ivec3(0, 0, 1)).z));
    result = at(velocity, TARGET, c) + vec4(dt * f, 0.0);
}
