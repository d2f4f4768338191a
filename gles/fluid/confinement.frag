// confinement.frag     f = eps (N x w),  N = grad |w| / |grad |w||        Fedkiw, Stam, Jensen 2001, section 5
//
// reads   vorticity  RGBA32F  Cells (nx, ny, nz)   [m/s]     w times h, and its length
// writes  f          RGBA32F  Cells                [m/s^2]   at the centres of the cells
// fetches 7
//
// Pushes around the middles of eddies what the transport has smoothed away. N is 0 where |w| has no slope to speak of.
uniform sampler2D vorticity;
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
    result = vec4(strength * cross(n, w.xyz), 0.0);
}
