// divergence.frag     d = 1/2 sum over the axes  (u_{+} - u_{-})    Crane, Llamas & Tariq 2007, ch. 30
//
// reads   velocity    RGBA32F  Cells (nx, ny, nz)    [m/s]
// reads   obstacles   RGBA32F  Cells, T_IO           variant OBSTACLES
// writes  d           R32F     Cells                 [m/s]   times h^2: volume flowing out of the cell per second
// fetches 12
//
// An obstacle neighbour counts with the obstacle's velocity, one beyond the walls with none. Without OBSTACLES: 6.
#ifdef OBSTACLES
#include "cell_types.glsl"
uniform sampler2D obstacles;
#endif
uniform sampler2D velocity;

out float d;

vec3 velocity_at(ivec3 c) {
    if (any(lessThan(c, ivec3(0))) || any(greaterThanEqual(c, TARGET.size))) return vec3(0.0);
    vec3 u = at(velocity, TARGET, c).xyz;
#ifdef OBSTACLES
    vec4 io = at(obstacles, TARGET, c);
    if (is_obstacle(io)) u = io.xyz;
#endif
    return u;
}

void main() {
    ivec3 c = cell_here(TARGET);
    d = 0.5 * (velocity_at(c + ivec3(1, 0, 0)).x - velocity_at(c - ivec3(1, 0, 0)).x +
               velocity_at(c + ivec3(0, 1, 0)).y - velocity_at(c - ivec3(0, 1, 0)).y +
               velocity_at(c + ivec3(0, 0, 1)).z - velocity_at(c - ivec3(0, 0, 1)).z);
}
