// beyond.glsl     What the fluid brings from beyond the last row of samples before a wall
//
// Positions are in texels of Faces: the component along an axis sits half a texel lower along it. Without FRICTION nothing
// changes: sampling with clamping has zero gradient at a wall the fluid slides along.
#ifdef FRICTION
// One component, sampled at s: between the row of samples nearest a wall and the wall, linear to the wall's velocity.
float to_walls(float u, int component, vec3 s) {
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == component) continue;
        vec3 x = s - 0.5 * vec3(equal(ivec3(component), ivec3(0, 1, 2)));
        float low = 0.5 * FRICTION_LOW[axis] * (1.0 - clamp(2.0 * s[axis], 0.0, 1.0));
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
