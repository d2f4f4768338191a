// project.frag     u = u* - 1/2 (phi_{+} - phi_{-});  u.n = u_obstacle.n beside obstacles   Crane et al. 2007, ch. 30
//
// reads   velocity    RGBA32F  Cells (nx, ny, nz)    [m/s]
// reads   phi         R32F     Cells                 [m/s]
// reads   obstacles   RGBA32F  Cells, T_IO           variant OBSTACLES
// writes  u           RGBA32F  Cells                 [m/s]
// fetches 15
//
// Beside an obstacle the velocity component across the shared face becomes the obstacle's; beside a wall, zero.
// The other components stay (free slip). Obstacle cells carry the obstacle's velocity. Without OBSTACLES: 8.
#ifdef OBSTACLES
#include "cell_types.glsl"
uniform sampler2D obstacles;
#endif
uniform sampler2D velocity, phi;

out vec4 result;

// Component `axis` of u in cell c; e is one step along it.
float projected(ivec3 c, ivec3 e, float u, float centre, int axis) {
    float low = at_clamped(phi, TARGET, c - e).x, high = at_clamped(phi, TARGET, c + e).x;
    bool blocked = c[axis] == 0 || c[axis] + 1 == TARGET.size[axis];
    float imposed = 0.0;
#ifdef OBSTACLES
    vec4 io_low = at_clamped(obstacles, TARGET, c - e), io_high = at_clamped(obstacles, TARGET, c + e);
    if (is_obstacle(io_low)) {
        low = centre;
        blocked = true;
        imposed = io_low[axis];
    }
    if (is_obstacle(io_high)) {
        high = centre;
        blocked = true;
        imposed = io_high[axis];
    }
#endif
    return blocked ? imposed : u - 0.5 * (high - low);
}

void main() {
    ivec3 c = cell_here(TARGET);
#ifdef OBSTACLES
    vec4 io = at(obstacles, TARGET, c);
    if (is_obstacle(io)) {
        result = vec4(io.xyz, 0.0);
        return;
    }
#endif
    vec3 u = at(velocity, TARGET, c).xyz;
    float p = at(phi, TARGET, c).x;
    result = vec4(projected(c, ivec3(1, 0, 0), u.x, p, 0), projected(c, ivec3(0, 1, 0), u.y, p, 1),
                  projected(c, ivec3(0, 0, 1), u.z, p, 2), 0.0);
}
