// diffusion_restrict.frag     rhs_coarse = mean of the residuals of the eight fine cells
//
// reads   field, rhs  R32F     Cells of the fine GRID     T's unit
// reads   ax, ay, az  RGBA32F  Faces4 of the fine grid    variant CUT
// writes  rhs_coarse  R32F     Cells of the coarse grid   T's unit     fine cells beyond an odd grid count as nothing
// fetches 64, CUT 112
#include "diffusion.glsl"

out float result;

void main() {
    ivec3 f = 2 * cell_here(TARGET);
    result = 0.0;
    for (int i = 0; i < 8; ++i) {
        ivec3 c = f + ivec3(i & 1, (i >> 1) & 1, i >> 2);
        float share, t;
        if (all(lessThan(c, CELLS))) result += 0.125 * residual(c, share, t);
    }
}
