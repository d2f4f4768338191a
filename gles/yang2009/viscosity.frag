// viscosity.frag     u = (u* + k sum of the six u_nb) / (1 + 6 k),  k = nu dt / h^2    Stam 1999, section 2.2
//
// reads   star        RGBA32F  Cells (nx, ny, nz)    [m/s]   u*, in obstacles the obstacle's velocity
// reads   velocity    RGBA32F  Cells                 [m/s]   the sweep before
// reads   obstacles   RGBA32F  Cells, T_IO           variant OBSTACLES
// writes  u           RGBA32F  Cells                 [m/s]   in obstacles u*
// fetches 7, OBSTACLES 8
//
// One Jacobi sweep of (1 - k laplacian) u = u*, as Harris 2004 (GPU Gems, ch. 38) solves it. An obstacle neighbour
// counts with the obstacle's velocity: no slip. One beyond a wall is this cell's mirror image: free slip; or, where the
// wall has FRICTION, what makes the velocity half-way, at the wall, the wall's own.
#ifdef OBSTACLES
#include "cell_types.glsl"
uniform sampler2D obstacles;
#endif
uniform sampler2D star, velocity;
uniform float diffusion;  // k

out vec4 result;

// The velocity of the cell beside c in direction +-axis.
vec3 neighbour(ivec3 c, int axis, int way) {
    bvec3 along = equal(ivec3(axis), ivec3(0, 1, 2));
    ivec3 e = way * ivec3(along);
    ivec3 inside = clamp(c + e, ivec3(0), TARGET.size - 1);
    vec3 u = at(velocity, TARGET, inside).xyz;
    if (inside == c + e) return u;
    vec3 slips = u;
#ifdef FRICTION
    bool sticks = (way < 0 ? FRICTION_LOW : FRICTION_HIGH)[axis] > 0.0;
    if (sticks) slips = 2.0 * wall_velocity(2 * axis + (way + 1) / 2, vec3(c) + 0.5 + 0.5 * vec3(e)) - u;
#endif
    return mix(slips, -u, along);  // nothing flows through
}

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 u = at(star, TARGET, c).xyz;
#ifdef OBSTACLES
    if (is_obstacle(at(obstacles, TARGET, c))) {
        result = vec4(u, 0.0);
        return;
    }
#endif
    vec3 neighbours = vec3(0.0);
    for (int axis = 0; axis < 3; ++axis) neighbours += neighbour(c, axis, -1) + neighbour(c, axis, 1);
    result = vec4((u + diffusion * neighbours) / (1.0 + 6.0 * diffusion), 0.0);
}
