// follow.frag     phi(x) = phi(x - d w(x)): the last pressure, shifted with a moving body, as a first guess
//
// reads   phi     RGBA32F  Cells4 (nx, ny, nz)   [m/s]
// writes  phi     RGBA32F  Cells4                [m/s]
// fetches 8
//
// Around a body the pressure moves with it: w = 1 on the body, falling to 0 at `reach`, where the field is left alone.
#include "guard.glsl"

uniform sampler2D phi;
uniform float most_phi;
uniform vec3 centre;  // of the body now                      [cells]
uniform vec3 moved;   // d, how far it came in this step      [cells]
uniform float inner, reach;  // radii where w = 1 and w = 0   [cells]

out vec4 result;

float layer(vec2 s, int z) {
    z = clamp(z, 0, CELLS.z - 1);
    return lane(sound(sample_slab(phi, TARGET, s, z >> 2), most_phi), z);  // guard guess
}

void main() {
    ivec3 c = cell_here(TARGET);
    for (int lane = 0; lane < 4; ++lane) {
        vec3 x = vec3(c.xy, 4 * c.z + lane) + 0.5;
        float w = 1.0 - smoothstep(inner, reach, distance(x, centre));
        vec3 s = clamp(x - w * moved, vec3(0.5), vec3(CELLS) - 0.5);
        float z = floor(s.z - 0.5);
        result[lane] = mix(layer(s.xy, int(z)), layer(s.xy, int(z) + 1), s.z - 0.5 - z);
    }
}
