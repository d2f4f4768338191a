// pressure_level.frag     Sum of phi over each part of a row of slabs
//
// reads   phi     RGBA32F  Cells4 (nx, ny, nz)   [m/s]
// writes  (sum phi, 0, 0, 0)   RGBA32F, (parts of rows, ny, slabs)
// fetches 8
#include "guard.glsl"

uniform sampler2D phi;
uniform float most_phi;

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    result = vec4(0.0);
    if (c.z >= TARGET.size.z) return;  // the atlas may end in tiles that hold nothing
    vec4 inside = vec4(lessThan(4 * c.z + ivec4(0, 1, 2, 3), ivec4(CELLS.z)));
    for (int i = 0; i < RUN; ++i) {
        ivec3 slab = ivec3(RUN * c.x + i, c.yz);
        if (slab.x >= CELLS.x) break;
        result.x += dot(inside, sound(at(phi, PHI, slab), most_phi));  // guard guess
    }
}
