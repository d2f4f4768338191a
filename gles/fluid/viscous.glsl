// viscous.glsl     The viscous term  sum over links  w (u_nb - u)  of the three faces of a texel, each component on its own
//
// A link joins a face to the next face of the same component. Where a wall the fluid sticks to lies between, w = 2 and u_nb
// is the wall's velocity (FRICTION_*, walls.h). Where a body's surface cuts the link at theta of its length, w = 1 / theta
// and u_nb is the body's velocity there: Gibou, Fedkiw, Cheng, Kang 2002, J. Comput. Phys. 176, eq. 16. Variant CUT reads
// the faces' distances to the bodies. Variant CORRECTION: walls and bodies stand still, as on the coarse grids.
#ifdef CUT
uniform sampler2D distances;  // of each face to the nearest body [cells of this grid]
const float kLeastTheta = 0.01;
#endif

// 1 where a component's face lies on a wall that decides what flows through it. In an opening the flow goes on unchanged.
vec3 on_walls(ivec3 c) {
    vec3 low = vec3(lessThanEqual(c, ivec3(0))), high = vec3(greaterThanEqual(c, CELLS));
#ifdef THROUGH
    low *= 1.0 - min(OPEN_LOW, 1.0);
    high *= 1.0 - min(OPEN_HIGH, 1.0);
#endif
    return low + high;
}

vec3 axis_of(int axis) {
    return vec3(equal(ivec3(axis), ivec3(0, 1, 2)));
}

// Where the surface cuts the links from c in direction e, counted from c; 1 where it does not. `cut`: 1 where it does.
#ifdef CUT
vec3 surface(ivec3 c, ivec3 e, vec3 here, out vec3 cut) {
    vec3 there = at_clamped(distances, FACES, c + e).xyz;
    cut = vec3(greaterThan(here, vec3(0.0))) * vec3(lessThanEqual(there, vec3(0.0)));
    return mix(vec3(1.0), clamp(here / max(here - there, vec3(1e-6)), kLeastTheta, 1.0), cut);
}

// The bodies' velocity at those points, component by component.
vec3 surface_velocity(ivec3 c, ivec3 e, vec3 theta) {
#ifdef CORRECTION
    return vec3(0.0);
#else
    vec3 x = vec3(c), f = vec3(e);
    return vec3(solid_velocity(x + vec3(0.0, 0.5, 0.5) + theta.x * f).x,
                solid_velocity(x + vec3(0.5, 0.0, 0.5) + theta.y * f).y,
                solid_velocity(x + vec3(0.5, 0.5, 0.0) + theta.z * f).z);
#endif
}
#endif

// Adds the links in direction +-axis to sum w u_nb and sum w.
void links(sampler2D velocity, ivec3 c, int axis, int sign, vec3 here, inout vec3 sum, inout vec3 weights) {
    vec3 along = axis_of(axis);
    ivec3 e = sign * ivec3(along);
    vec3 value = at_clamped(velocity, FACES, c + e).xyz, w = vec3(1.0);
    // The component across the wall has faces on it; the other two have their last ones half a cell before it.
    bool at_wall = sign < 0 ? c[axis] == 0 : c[axis] + 1 >= CELLS[axis];
    if (at_wall) {
#ifdef FRICTION
        float friction = sign < 0 ? FRICTION_LOW[axis] : FRICTION_HIGH[axis];
#ifdef CORRECTION
        vec3 of_wall = vec3(0.0);
#else
        int wall = 2 * axis + (sign > 0 ? 1 : 0);
        vec3 x = vec3(c) + 0.5 * vec3(e);  // a component's face is half a cell lower along its own axis
        vec3 of_wall = vec3(wall_velocity(wall, x + vec3(0.0, 0.5, 0.5)).x, wall_velocity(wall, x + vec3(0.5, 0.0, 0.5)).y,
                            wall_velocity(wall, x + vec3(0.5, 0.5, 0.0)).z);
#endif
#else
        float friction = 0.0;
        vec3 of_wall = vec3(0.0);
#endif
        w = mix(vec3(friction), w, along);
        value = mix(of_wall, value, along);
    }
#ifdef CUT
    vec3 cut, theta = surface(c, e, here, cut);
    cut *= float(!at_wall) * (1.0 - along) + along;
    w = mix(w, 1.0 / theta, cut);
    value = mix(value, surface_velocity(c, e, theta), cut);
#endif
    sum += w * value;
    weights += w;
}

// sum w (u_nb - u); weights = sum w; centre = u itself. fixed_at: 1 where u is given and no equation holds.
vec3 viscous_term(sampler2D velocity, ivec3 c, out vec3 weights, out vec3 centre, out vec3 fixed_at) {
    centre = at(velocity, FACES, c).xyz;
    vec3 sum = vec3(0.0), here = vec3(1.0);
    weights = vec3(0.0);
#ifdef CUT
    here = at(distances, FACES, c).xyz;
#endif
    for (int axis = 0; axis < 3; ++axis) {
        links(velocity, c, axis, -1, here, sum, weights);
        links(velocity, c, axis, 1, here, sum, weights);
    }
    fixed_at = min(on_walls(c) + vec3(lessThanEqual(here, vec3(0.0))), 1.0);
    // Texels of the upper layers hold one wall face and copies.
    for (int axis = 0; axis < 3; ++axis)
        if (c[axis] >= CELLS[axis]) fixed_at = max(fixed_at, 1.0 - axis_of(axis));
    return sum - weights * centre;
}
