// reflect.frag     u^ = 2 u - u*          the flow before its projection, mirrored at the flow after it
//
// reads   velocity, before   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]     u and u*
// writes  u^                 RGBA32F  Faces                      [m/s]     in the upper layers what no face owns repeats its neighbour
// fetches 6
uniform sampler2D velocity, before;

out vec4 result;

vec3 mirrored(ivec3 c) {
    return 2.0 * at(velocity, TARGET, c).xyz - at(before, TARGET, c).xyz;
}

void main() {
    ivec3 c = cell_here(TARGET), m = min(c, TARGET.size - 2);
    result = vec4(mirrored(ivec3(c.x, m.yz)).x, mirrored(ivec3(m.x, c.y, m.z)).y, mirrored(ivec3(m.xy, c.z)).z, 0.0);
}
