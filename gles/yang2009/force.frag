// force.frag     T_F = -phi sum n,  its moment r x T_F        in surrounding cells    Yang et al. 2009, eq. 2, 9, 10
//
// reads   phi         R32F     Cells (nx, ny, nz)    [m/s]
// reads   obstacles   RGBA32F  Cells, T_IO
// writes  force       RGBA32F  Cells, T_F            rgb [m/s cells^2]    ON the body; elsewhere 0
// writes  moment      RGBA32F  Cells                 rgb [m/s cells^3]    about the body's centre
// fetches 1
//
// 8 in the few surrounding cells. The sum runs over the faces shared with boundary cells; n points out of the body, that
// is from the boundary cell to this one. A face's centre lies along n from this cell's, so r may end in either.
#include "cell_types.glsl"

uniform sampler2D phi, obstacles;
uniform vec3 pivot;  // the body's centre  [cells]
uniform int body;

layout(location = 0) out vec4 force;
layout(location = 1) out vec4 moment;

// n of the face in direction e: -e where a boundary cell of this body lies behind it.
vec3 normal(ivec3 c, ivec3 e) {
    bool body_behind = is_obstacle(at_clamped(obstacles, TARGET, c + e)) && nearest_body(vec3(c + e) + 0.5) == body;
    return body_behind ? vec3(-e) : vec3(0.0);
}

void main() {
    ivec3 c = cell_here(TARGET);
    force = vec4(0.0);
    moment = vec4(0.0);
    if (at(obstacles, TARGET, c).w != kSurrounding) return;
    vec3 n = normal(c, ivec3(1, 0, 0)) + normal(c, ivec3(-1, 0, 0)) + normal(c, ivec3(0, 1, 0)) +
             normal(c, ivec3(0, -1, 0)) + normal(c, ivec3(0, 0, 1)) + normal(c, ivec3(0, 0, -1));
    force.xyz = -at(phi, TARGET, c).x * n;
    moment.xyz = cross(vec3(c) + 0.5 - pivot, force.xyz);
}
