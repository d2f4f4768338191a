// vorticity.frag     w = curl u at the centres of the cells, and |w|
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// writes  w, |w|     RGBA32F  Cells (nx, ny, nz)         [m/s]   times h: differences over one cell
// fetches 24
#include "velocity.glsl"

uniform sampler2D velocity;

out vec4 result;

vec3 difference(ivec3 c, ivec3 e) {
    ivec3 low = max(c - e, ivec3(0)), high = min(c + e, CELLS - 1);
    vec3 d = velocity_in_cell(velocity, high) - velocity_in_cell(velocity, low);
    return d / max(float((high - low).x + (high - low).y + (high - low).z), 1.0);
}

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 dx = difference(c, ivec3(1, 0, 0)), dy = difference(c, ivec3(0, 1, 0)), dz = difference(c, ivec3(0, 0, 1));
    vec3 w = vec3(dy.z - dz.y, dz.x - dx.z, dx.y - dy.x);
    result = vec4(w, length(w));
}
