// diffusion_prolong.frag     T += trilinear(T_coarse)
//
// reads   field       R32F     Cells (nx, ny, nz)          T's unit
// reads   correction  R32F     Cells of the COARSE grid    T's unit
// reads   ax, ay, az  RGBA32F  Faces4                      variant CUT: where all is solid T stays as it is
// writes  T           R32F     Cells
// fetches 3, CUT 9
#include "diffusion.glsl"

uniform sampler2D correction;

out float result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 low, high;
    openings(c, low, high);
    float change = sample_linear(correction, COARSE, 0.5 * (vec3(c) + 0.5)).x;
    result = at(field, GRID, c).x + (dot(low + high, vec3(1.0)) > 0.0 ? change : 0.0);
}
