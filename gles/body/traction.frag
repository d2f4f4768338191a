// traction.frag     f = sum over a column of cells  phi grad(1 - a)        and its moment about the body's centre
//
// reads   phi         RGBA32F  Cells4 (nx, ny, nz)       [m/s]
// reads   ax, ay, az  RGBA32F  Faces4                    fluid fraction
// writes  force, moment   RGBA32F, one texel for each column of the body's box: rgb  [m/s cells^2], [m/s cells^3]
// reads   velocity    RGBA32F  Faces (nx+1, ny+1, nz+1)  [m/s]     variant VISCOUS: after the viscous step
// reads   distances   RGBA32F  Faces                     [cells]   variant VISCOUS
// fetches 50, VISCOUS 520          10 for each slab of four layers, and 24 a cell; a ball of 5 cells has 5 slabs
//
// p grad(1 - a) is -p n dA in the form that does exactly the work the projection does on the fluid: with it,
// force . U is the power that the body gives, to rounding. Times rho h^3 / dt it is newtons (rho h^4 / dt: newton metres).
// VISCOUS adds what the fluid's faces gave the body over their links to it: lambda w (u - u_solid), as viscous.glsl has it.
#ifdef VISCOUS
#include "fluid/viscous.glsl"
uniform sampler2D velocity;
uniform float lambda;  // nu dt / h^2
#endif
uniform sampler2D phi, ax, ay, az;
uniform ivec3 box_low, box_high;  // in cells; z in slabs of four
uniform vec3 pivot;               // the body's centre  [cells]
uniform int body;

layout(location = 0) out vec4 force;
layout(location = 1) out vec4 moment;

void add(vec3 x, vec3 f) {
    force.xyz += f;
    moment.xyz += cross(x - pivot, f);
}

#ifdef VISCOUS
void add_friction(ivec3 c) {
    vec3 u = at(velocity, FACES, c).xyz, here = at(distances, FACES, c).xyz, given = on_walls(c);
    for (int way = 0; way < 6; ++way) {
        ivec3 e = (way % 2 == 0 ? 1 : -1) * ivec3(axis_of(way / 2));
        vec3 cut, theta = surface(c, e, here, cut);
        vec3 f = lambda * (1.0 - given) * cut * (u - surface_velocity(c, e, theta)) / theta;
        for (int k = 0; k < 3; ++k) {
            vec3 x = vec3(c) + 0.5 - 0.5 * axis_of(k) + theta[k] * vec3(e);
            if (cut[k] > 0.0 && nearest_body(x) == body) add(x, f[k] * axis_of(k));
        }
    }
}
#endif

float potential(ivec3 c) {
    c = clamp(c, ivec3(0), CELLS - 1);
    return dot(at(phi, PHI, ivec3(c.xy, c.z >> 2)), vec4(equal(ivec4(c.z & 3), ivec4(0, 1, 2, 3))));
}

#ifdef VISCOUS
// phi in cell c between faces of these open shares. Where the fluid sticks to the body, no fluid moves through a face
// whose centre is in it: a cell with no other open face has no equation, and its pressure is that of its neighbours, carried
// on linearly.
float pressure(ivec3 c, vec3 low, vec3 high) {
    vec3 d_low = at(distances, FACES, c).xyz;
    vec3 d_high = vec3(at(distances, FACES, c + ivec3(1, 0, 0)).x, at(distances, FACES, c + ivec3(0, 1, 0)).y,
                       at(distances, FACES, c + ivec3(0, 0, 1)).z);
    vec3 moves = low * vec3(greaterThan(d_low, vec3(0.0))) + high * vec3(greaterThan(d_high, vec3(0.0)));
    float open = dot(low + high, vec3(1.0));
    if (dot(moves, vec3(1.0)) > 0.0 || open == 0.0) return potential(c);
    float sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 e = ivec3(axis_of(axis));
        sum += low[axis] * (2.0 * potential(c - e) - potential(c - 2 * e));
        sum += high[axis] * (2.0 * potential(c + e) - potential(c + 2 * e));
    }
    return sum / open;
}
#else
float pressure(ivec3 c, vec3 low, vec3 high) {
    return potential(c);
}
#endif

void main() {
    force = vec4(0.0);
    moment = vec4(0.0);
    ivec2 column = ivec2(gl_FragCoord.xy) + box_low.xy;
    if (any(greaterThanEqual(column, box_high.xy))) return;
    for (int slab = box_low.z; slab < box_high.z; ++slab) {
        ivec3 c = ivec3(column, slab);
        vec4 lx = at(ax, FRACTION, c), hx = at(ax, FRACTION, c + ivec3(1, 0, 0));
        vec4 ly = at(ay, FRACTION, c), hy = at(ay, FRACTION, c + ivec3(0, 1, 0));
        vec4 lz = at(az, FRACTION, c), hz = vec4(lz.yzw, at_clamped(az, FRACTION, c + ivec3(0, 0, 1)).x);
        for (int lane = 0; lane < 4; ++lane) {
            ivec3 cell = ivec3(column, 4 * slab + lane);
            if (cell.z >= CELLS.z) break;
            vec3 x = vec3(cell) + 0.5;
            vec3 low = vec3(lx[lane], ly[lane], lz[lane]), high = vec3(hx[lane], hy[lane], hz[lane]);
#ifdef VISCOUS
            add_friction(cell);
#endif
            if (nearest_body(x) == body) add(x, pressure(cell, low, high) * (low - high));
        }
    }
}
