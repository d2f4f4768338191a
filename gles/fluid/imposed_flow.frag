// imposed_flow.frag     u = the scene's formula, each component on its own face
//
// reads   nothing
// writes  u       RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// fetches 0
out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    // In the upper layers what no face owns repeats its neighbour (velocity.glsl).
    vec3 x = vec3(c), m = vec3(min(c, CELLS - 1)) + 0.5;
    result = vec4(imposed_velocity(vec3(x.x, m.yz)).x, imposed_velocity(vec3(m.x, x.y, m.z)).y,
                  imposed_velocity(vec3(m.xy, x.z)).z, 0.0);
}
