// pressure_level.frag     Over each part of a row of slabs: sum of phi, and of |grad phi|^4 where the fluid is open
//
// reads   phi          RGBA32F  Cells4 (nx, ny, nz)   [m/s]
// reads   ax, ay, az   RGBA32F  Faces4
// writes  (sum phi, sum |grad phi|^4, 0, 0)   RGBA32F, (parts of rows, ny, slabs)
// fetches 64
#include "open.glsl"

uniform sampler2D phi, ax, ay, az;
uniform float most_phi;

out vec4 result;

// What is less open than this may throttle a pocket, and is not where its pressure comes from.
const float kOpen = 0.05;

vec4 phi_at(ivec3 slab) {
    return sound(at_clamped(phi, PHI, slab), most_phi);  // guard guess
}

vec4 steps(vec4 from, vec4 to, vec4 a) {
    return mix(vec4(0.0), to - from, greaterThan(a, vec4(kOpen)));
}

void main() {
    ivec3 c = cell_here(TARGET);
    result = vec4(0.0);
    if (c.z >= TARGET.size.z) return;  // the atlas may end in tiles that hold nothing
    ivec4 layers = 4 * c.z + ivec4(0, 1, 2, 3);
    vec4 inside = vec4(lessThan(layers, ivec4(CELLS.z))), has_above = vec4(lessThan(layers + 1, ivec4(CELLS.z)));
    for (int i = 0; i < RUN; ++i) {
        ivec3 slab = ivec3(RUN * c.x + i, c.yz);
        if (slab.x >= CELLS.x) break;
        vec4 p = phi_at(slab);
        vec4 above = vec4(p.yzw, phi_at(slab + ivec3(0, 0, 1)).x);
        vec4 dx = steps(p, phi_at(slab + ivec3(1, 0, 0)), inside * share(at(ax, FRACTION, slab + ivec3(1, 0, 0))));
        vec4 dy = steps(p, phi_at(slab + ivec3(0, 1, 0)), inside * share(at(ay, FRACTION, slab + ivec3(0, 1, 0))));
        vec4 dz = steps(p, above, has_above * upper_z(az, FRACTION, slab, share(at(az, FRACTION, slab))));
        vec4 square = dx * dx + dy * dy + dz * dz;
        result.xy += vec2(dot(inside, p), dot(square, square));
    }
}
