// advect_velocity.frag     u* = u(x - dt u);  u* = u_obstacle in obstacles    Crane, Llamas & Tariq 2007, ch. 30
//
// reads   velocity    RGBA32F  Cells (nx, ny, nz)    [m/s]
// reads   obstacles   RGBA32F  Cells, T_IO           variant OBSTACLES
// writes  u*          RGBA32F  Cells                 [m/s]
// fetches 4
//
// Without OBSTACLES: 3.
#ifdef OBSTACLES
#include "cell_types.glsl"
uniform sampler2D obstacles;
#endif
#include "guard.glsl"

uniform sampler2D velocity;
uniform float dt_h;  // dt / h  [s/m]

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
#ifdef OBSTACLES
    vec4 io = at(obstacles, TARGET, c);
    if (is_obstacle(io)) {
        result = vec4(io.xyz, 0.0);
        return;
    }
#endif
    vec3 moved = sound(dt_h * at(velocity, TARGET, c).xyz, FARTHEST);                                // guard carrier
    result = sound(sample_linear(velocity, TARGET, vec3(c) + 0.5 - moved), FARTHEST / dt_h);         // guard velocity
}
