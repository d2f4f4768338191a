// traction.frag     f = sum over a column of cells  phi grad(1 - a)        and its moment about the body's centre
//
// reads   phi         RGBA32F  Cells4 (nx, ny, nz)       [m/s]
// reads   ax, ay, az  RGBA32F  Faces4                    fluid fraction
// writes  force, moment   RGBA32F, one texel for each column of the body's box: rgb  [m/s cells^2], [m/s cells^3]
//         variants FORCE, TORQUE: which of them, and to which output
// reads   velocity    RGBA32F  Faces (nx+1, ny+1, nz+1)  [m/s]     variant VISCOUS: after the viscous step
// reads   distances, grips, surface   RGBA32F  Faces     as grip.frag has them   variant VISCOUS
// fetches 50, VISCOUS 250          10 for each slab of four layers, and 10 a cell; a ball of 5 cells has 5 slabs
//
// p grad(1 - a) is -p n dA in the form that does exactly the work the projection does on the fluid: with it,
// force . U is the power that the body gives, to rounding. Times rho h^3 / dt it is newtons (rho h^4 / dt: newton metres).
// VISCOUS adds what the fluid gave where the body holds it, lambda w (u - u_surface): what viscous.glsl took from it.
// That is mu du/dn; the traction is mu (du/dn + (grad u)^T n). Where the fluid sticks to a body that moves as u = U + s x r,
// the second part is n x s, because div u = 0 leaves no other: a torque, mu r x (n x s) dA, and no force.
#include "open.glsl"

#ifdef VISCOUS
uniform sampler2D velocity, distances, grips, surface;
uniform float lambda;  // nu dt / h^2
#include "beyond_walls.glsl"
#endif
uniform sampler2D phi, ax, ay, az;
uniform ivec3 box_low, box_high;  // in cells; z in slabs of four
uniform int body;
#ifdef FORCE
layout(location = FORCE) out vec4 force;
#endif
#ifdef TORQUE
uniform vec3 pivot;  // the body's centre  [cells]
layout(location = TORQUE) out vec4 moment;
#endif

void add(vec3 x, vec3 f) {
#ifdef FORCE
    force.xyz += f;
#endif
#ifdef TORQUE
    moment.xyz += cross(x - pivot, f);
#endif
}

#ifdef VISCOUS
// The force of each component acts where the surface is nearest to its face. Faces on the tank's walls are left out: closed ones
// carry no flow, and of the fluid around one in an opening only half a cell lies in the tank. That half is missing for a body
// that stands in the opening: n cells long from one opening to the other, it feels 1/n too little friction along itself
// (12 % at 8 cells, tests/physics/thin_plate_test.cpp). force_methods.h leaves out the same half.
void add_friction(ivec3 c) {
    vec3 d = at(distances, FACES, c).xyz;
    vec3 slope[3];
    for (int axis = 0; axis < 3; ++axis) {
        ivec3 e = ivec3(equal(ivec3(axis), ivec3(0, 1, 2)));
        vec3 low = at_clamped(distances, FACES, c - e).xyz, high = at_clamped(distances, FACES, c + e).xyz;
        go_on_beyond_walls(c, axis, d, low, high);
        slope[axis] = 0.5 * (high - low);
    }
    vec3 f = lambda * at(grips, FACES, c).xyz * (at(velocity, FACES, c).xyz - at(surface, FACES, c).xyz);
    for (int k = 0; k < 3; ++k) {
        if (f[k] == 0.0 || c[k] == 0) continue;
        vec3 along = vec3(equal(ivec3(k), ivec3(0, 1, 2)));
        vec3 n = vec3(slope[0][k], slope[1][k], slope[2][k]);
        vec3 x = vec3(c) + 0.5 - 0.5 * along - d[k] * n / max(length(n), 0.1);
        if (nearest_body(x) == body) add(x, f[k] * along);
    }
}
#endif

// 1 for the faces of the cell around x, on its upper (0.5) or lower (-0.5) sides, whose solid share is this body's. Each has
// its own, as in divergence.frag: between bodies that nearly touch, a cell's faces belong to both.
vec3 own(vec3 x, float side) {
    return vec3(nearest_body(x + vec3(side, 0.0, 0.0)) == body,
                nearest_body(x + vec3(0.0, side, 0.0)) == body,
                nearest_body(x + vec3(0.0, 0.0, side)) == body);
}

void main() {
#ifdef FORCE
    force = vec4(0.0);
#endif
#ifdef TORQUE
    moment = vec4(0.0);
#endif
    ivec2 column = ivec2(gl_FragCoord.xy) + box_low.xy;
    if (any(greaterThanEqual(column, box_high.xy))) return;
    for (int slab = box_low.z; slab < box_high.z; ++slab) {
        ivec3 c = ivec3(column, slab);
        vec4 p = at(phi, PHI, c);
        vec4 lx = at(ax, FRACTION, c), hx = at(ax, FRACTION, c + ivec3(1, 0, 0));
        vec4 ly = at(ay, FRACTION, c), hy = at(ay, FRACTION, c + ivec3(0, 1, 0));
        vec4 lz = at(az, FRACTION, c), hz = upper_z(az, FRACTION, c, lz);
        for (int lane = 0; lane < 4; ++lane) {
            ivec3 cell = ivec3(column, 4 * slab + lane);
            if (cell.z >= CELLS.z) break;
            vec3 x = vec3(cell) + 0.5;
            vec3 low = vec3(lx[lane], ly[lane], lz[lane]), high = vec3(hx[lane], hy[lane], hz[lane]);
            vec3 solid = (1.0 - high) * own(x, 0.5) - (1.0 - low) * own(x, -0.5);
#ifdef VISCOUS
            add_friction(cell);
#ifdef TORQUE
            moment.xyz += lambda * cross(x - pivot, cross(body_spin[body], solid));
#endif
#endif
            add(x, p[lane] * solid);
        }
    }
}
