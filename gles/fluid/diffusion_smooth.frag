// diffusion_smooth.frag     T += omega (V rhs - V T + lambda inflow) / d           weighted Jacobi
//
// reads   field, rhs  R32F     Cells (nx, ny, nz)    T's unit     field not by variant FROM_ZERO, which starts from T = 0
// reads   ax, ay, az  RGBA32F  Faces4                variant CUT
// writes  T           R32F     Cells                 where all is solid as it was
// fetches 8, CUT 14, FROM_ZERO 1, CUT+FROM_ZERO 7
//
// d = V (1 + 6 lambda), as if there were no walls: what one cell gains in a sweep others lose, and whatever the sweeps leave
// undone, the sum of V T stays that of V rhs.
#include "diffusion.glsl"

uniform float omega;

out float result;

void main() {
    float share, t;
    float r = residual(cell_here(TARGET), share, t);
    result = share > 0.0 ? t + omega * r / (share * (1.0 + 6.0 * lambda)) : t;
}
