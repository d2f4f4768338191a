// confinement.frag     f = eps (N x w),  N = grad |w| / |grad |w||        Fedkiw, Stam, Jensen 2001, section 5
//
// reads   vorticity  RGBA32F  Cells (nx, ny, nz)   [m/s]     w times h, and its length
// reads   velocity   RGBA32F  Faces                [m/s]
// writes  f          RGBA32F  Cells                [m/s^2]   at the centres of the cells
// fetches 11
//
// Pushes around the middles of eddies what the transport has smoothed away. N is 0 where |w| has no slope to speak of.
// Fluid that is faster than what has lately driven it is pushed less, and from 1.5 times that on not at all: f goes with the
// flow, and would feed it without end.
#include "velocity.glsl"

uniform sampler2D vorticity, velocity;
uniform float driven;  // [m/s]
uniform float strength;  // eps [1/s]

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 slope = vec3(at_clamped(vorticity, TARGET, c + ivec3(1, 0, 0)).w - at_clamped(vorticity, TARGET, c - ivec3(1, 0, 0)).w,
                      at_clamped(vorticity, TARGET, c + ivec3(0, 1, 0)).w - at_clamped(vorticity, TARGET, c - ivec3(0, 1, 0)).w,
                      at_clamped(vorticity, TARGET, c + ivec3(0, 0, 1)).w - at_clamped(vorticity, TARGET, c - ivec3(0, 0, 1)).w);
    vec4 w = at(vorticity, TARGET, c);
    float steepness = length(slope);
    vec3 n = slope / max(steepness, 1e-6 * w.w + 1e-20);
    float speed = length(velocity_in_cell(velocity, c));
    float share = 1.0 - smoothstep(1.0, 1.5, min(speed / max(driven, 1e-30), 2.0));  // guard confinement
    result = vec4(share * strength * cross(n, w.xyz), 0.0);
}
