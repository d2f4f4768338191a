// jacobi.frag     phi = (sum of the six phi_nb - d) / 6    Crane, Llamas & Tariq 2007, ch. 30
//
// reads   phi         R32F     Cells (nx, ny, nz)    [m/s]   dt p / (rho h)
// reads   d           R32F     Cells                 [m/s]
// reads   obstacles   RGBA32F  Cells, T_IO           variant OBSTACLES
// writes  phi         R32F     Cells                 [m/s]
// fetches 14
//
// An obstacle neighbour, like one beyond the walls, counts with the centre's own phi: no gradient across that face.
// Without OBSTACLES: 8.
#ifdef OBSTACLES
#include "cell_types.glsl"
uniform sampler2D obstacles;
#endif
uniform sampler2D phi, d;

out float result;

float phi_at(ivec3 c, float centre) {
    float p = at_clamped(phi, TARGET, c).x;  // beyond a wall: the centre again
#ifdef OBSTACLES
    if (is_obstacle(at_clamped(obstacles, TARGET, c))) p = centre;
#endif
    return p;
}

void main() {
    ivec3 c = cell_here(TARGET);
    float p = at(phi, TARGET, c).x;
    result = (phi_at(c - ivec3(1, 0, 0), p) + phi_at(c + ivec3(1, 0, 0), p) + phi_at(c - ivec3(0, 1, 0), p) +
              phi_at(c + ivec3(0, 1, 0), p) + phi_at(c - ivec3(0, 0, 1), p) + phi_at(c + ivec3(0, 0, 1), p) -
              at(d, TARGET, c).x) / 6.0;
}
