// viscous.glsl     The viscous term  sum over links  w (u_nb - u)  of the three faces of a texel, each component on its own
//
// A link joins a face to the next face of the same component. Where a wall the fluid sticks to lies between, w = 2 and u_nb
// is the wall's velocity (FRICTION_*, walls.h). Variant CUT: the link is as wide as the mean share of fluid in the two
// faces' cells, that to a wall as the face's own, and a body's surface holds on to its faces as grip.frag says. Variant CORRECTION: walls and bodies stand still,
// as on the coarse grids.
// Variant TO_WALL (vec3): on such a grid the last cell of an axis may lie in the tank only in part; so much stronger is the link
// from the last free face to that on the wall. Without it a grid of one more than a power of two cells has its coarsest
// grids move what the wall holds, and each cycle makes the error larger.
#ifdef CUT
uniform sampler2D shares;  // of fluid in the cell around each face
uniform sampler2D grips;
#ifndef CORRECTION
uniform sampler2D surface;  // the bodies' velocity where they hold a face  [m/s]
#endif
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

// Adds the links in direction +-axis to sum w u_nb and sum w.
void links(sampler2D velocity, ivec3 c, int axis, int sign, vec3 share, inout vec3 sum, inout vec3 weights) {
    vec3 along = axis_of(axis);
    ivec3 e = sign * ivec3(along);
    vec3 value = at_clamped(velocity, FACES, c + e).xyz, w = vec3(1.0);
    // The component across the wall has faces on it; the other two have their last ones half a cell before it.
    bool at_wall = sign < 0 ? c[axis] == 0 : c[axis] + 1 >= CELLS[axis];
    if (at_wall) {
#ifdef TO_WALL
        if (sign > 0) w *= TO_WALL;
#endif
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
    vec3 share_nb = at_clamped(shares, FACES, c + e).xyz;
    if (at_wall) share_nb = mix(share, share_nb, along);
    w *= 0.5 * (share + share_nb) * vec3(greaterThan(share_nb, vec3(0.0)));
#endif
    sum += w * value;
    weights += w;
}

// sum w (u_nb - u); weights = sum w; centre = u itself; share = the fluid's share that it stands for.
// fixed_at: 1 where u is given and no equation holds.
vec3 viscous_term(sampler2D velocity, ivec3 c, out vec3 weights, out vec3 centre, out vec3 share, out vec3 fixed_at) {
    centre = at(velocity, FACES, c).xyz;
    vec3 sum = vec3(0.0);
    weights = vec3(0.0);
    share = vec3(1.0);
#ifdef CUT
    share = at(shares, FACES, c).xyz;
#endif
    for (int axis = 0; axis < 3; ++axis) {
        links(velocity, c, axis, -1, share, sum, weights);
        links(velocity, c, axis, 1, share, sum, weights);
    }
#ifdef CUT
    vec3 grip = at(grips, FACES, c).xyz;
    weights += grip;
#ifndef CORRECTION
    sum += grip * at(surface, FACES, c).xyz;
#endif
#endif
    fixed_at = min(on_walls(c) + vec3(lessThanEqual(share, vec3(0.0))), 1.0);
    // Texels of the upper layers hold one wall face and copies.
    for (int axis = 0; axis < 3; ++axis)
        if (c[axis] >= CELLS[axis]) fixed_at = max(fixed_at, 1.0 - axis_of(axis));
    return sum - weights * centre;
}
