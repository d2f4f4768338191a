// solve_coarsest.frag     A phi = b on a grid of at most 4 x 4 x 4 cells: all sweeps, from phi = 0, in one pass
//
// reads   b          RGBA32F  Cells4    [m/s]
// reads   ax, ay, az RGBA32F  Faces4    variant CUT
// writes  phi        RGBA32F  Cells4    [m/s]     a cell with no open face stays 0
// fetches 16, CUT 784
//
// Every fragment solves the whole grid and keeps its own column: a hundredth of the work of a sweep of the finest grid, and
// seven passes less, each of which costs more than all they compute.
#include "poisson.glsl"

uniform sampler2D b;
uniform int sweeps;  // how many: no constant, as drivers that write loops out take seconds to compile them all

out vec4 result;

const float omega[] = OMEGA;  // relaxation of each sweep
const int COLUMNS = CELLS.x * CELLS.y;

int column(int x, int y) { return clamp(x, 0, CELLS.x - 1) + CELLS.x * clamp(y, 0, CELLS.y - 1); }

void main() {
    vec4 right_side[COLUMNS], p[COLUMNS], next[COLUMNS];
    for (int i = 0; i < COLUMNS; ++i) {
        right_side[i] = at(b, PHI, ivec3(i % CELLS.x, i / CELLS.x, 0));
        p[i] = vec4(0.0);
    }
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (int i = 0; i < COLUMNS; ++i) {
            int x = i % CELLS.x, y = i / CELLS.x;
            Neighbours n = Neighbours(p[i], p[column(x - 1, y)], p[column(x + 1, y)], p[column(x, y - 1)],
                                      p[column(x, y + 1)], shifted_down(p[i], p[i]), shifted_up(p[i], p[i]));
            vec4 d;
            vec4 lap = balance(ivec3(x, y, 0), n, d);
            vec4 closed = vec4(lessThan(d, vec4(1e-6)));
            next[i] = p[i] + (1.0 - closed) * omega[sweep] * (lap - right_side[i]) / (d + closed);
        }
        p = next;
    }
    ivec3 c = cell_here(TARGET);
    result = p[column(c.x, c.y)];
}
