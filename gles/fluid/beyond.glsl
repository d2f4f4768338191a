// beyond.glsl     What the fluid brings from beyond the last row of samples before a wall, and from outside
//
// Positions are in texels of Faces: the component along an axis sits half a texel lower along it. Without FRICTION nothing
// changes: sampling with clamping has zero gradient at a wall the fluid slides along.
#ifdef FRICTION
// One component, sampled at s: between the row of samples nearest a wall and the wall, linear to the wall's velocity.
float to_walls(float u, int component, vec3 s) {
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == component) continue;
        vec3 x = s - 0.5 * vec3(equal(ivec3(component), ivec3(0, 1, 2)));
        float low = min(FRICTION_LOW[axis], 1.0) * (1.0 - clamp(2.0 * s[axis], 0.0, 1.0));
        float high = min(FRICTION_HIGH[axis], 1.0) * (1.0 - clamp(2.0 * (float(FACES.size[axis]) - 1.0 - s[axis]), 0.0, 1.0));
        if (low > 0.0) u = mix(u, wall_velocity(2 * axis, x)[component], low);
        if (high > 0.0) u = mix(u, wall_velocity(2 * axis + 1, x)[component], high);
    }
    return u;
}
#else
float to_walls(float u, int component, vec3 s) {
    return u;
}
#endif

// The share that is left of one component when it is carried in from s. Before an opening the fluid is at rest, a cell away: along the
// first half a cell inside, that takes u^2 / 2 of pressure (Bernoulli). If the fluid came in as fast as what is just inside, flow that
// turns back at an opening would feed on itself and grow without bound (backflow instability: N. Ni, Z. Yang, S. Dong 2018,
// "Energy-stable boundary conditions", arXiv:1807.07056).
float from_rest(int component, vec3 s) {
#ifdef THROUGH
    vec3 x = s - 0.5 * vec3(equal(ivec3(component), ivec3(0, 1, 2)));
    vec3 beyond = min(OPEN_LOW, 1.0) * max(-x, 0.0) + min(OPEN_HIGH, 1.0) * max(x - vec3(FACES.size - 1), 0.0);
    return 1.0 - min(max(max(beyond.x, beyond.y), beyond.z), 1.0);  // guard backflow
#else
    return 1.0;
#endif
}

// 0 where what is carried to here comes in through an inflow or an opening: clear fluid. s in texels of Cells.
float from_inside(vec3 s) {
#ifdef THROUGH
    vec3 below = vec3(lessThan(s, vec3(0.0))) * min(OPEN_LOW + INFLOW_LOW, 1.0);
    vec3 above = vec3(greaterThan(s, vec3(FACES.size - 1))) * min(OPEN_HIGH + INFLOW_HIGH, 1.0);
    return all(equal(below + above, vec3(0.0))) ? 1.0 : 0.0;
#else
    return 1.0;
#endif
}
