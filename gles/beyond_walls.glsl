// beyond_walls.glsl     What lies beside a face where the tank ends: faces have no neighbour there, or one that no flow goes through
//
// 1 for the components of face c that have no neighbour further up an axis: along it the last is the wall's own face, across it
// the one half a cell before the wall.
vec3 last_before_wall(ivec3 c, int axis) {
    vec3 along = vec3(equal(ivec3(axis), ivec3(0, 1, 2)));
    return mix(vec3(c[axis] + 2 >= FACES.size[axis]), vec3(c[axis] + 1 >= FACES.size[axis]), along);
}

// Distances beside that of c, on both sides along an axis: beyond a wall they go on as they came, the same at lower and upper ones.
void go_on_beyond_walls(ivec3 c, int axis, vec3 here, inout vec3 low, inout vec3 high) {
    if (c[axis] == 0) low = 2.0 * here - high;
    high = mix(high, 2.0 * here - low, last_before_wall(c, axis));
}
