// velocity.glsl     Where velocities live, and how to read one between the places where they live.
//
// The velocity texture holds in texel (i,j,k) u on the face at (i, j+1/2, k+1/2), v at (i+1/2, j, k+1/2) and
// w at (i+1/2, j+1/2, k), in cells. In texel coordinates (centres at +1/2) all three sit at (i+1/2, j+1/2, k+1/2).
// One layer more in each direction holds the upper walls; what no face owns there repeats its neighbour, so that
// sampling with clamping has zero gradient at the wall.

// Velocity at the centre of cell c.
vec3 velocity_in_cell(sampler2D velocity, ivec3 c) {
    vec3 low = at(velocity, FACES, c).xyz;
    return 0.5 * (low + vec3(at_clamped(velocity, FACES, c + ivec3(1, 0, 0)).x,
                             at_clamped(velocity, FACES, c + ivec3(0, 1, 0)).y,
                             at_clamped(velocity, FACES, c + ivec3(0, 0, 1)).z));
}

// Velocity at the centres of the three lower faces of cell c, one per component's face. Each neighbour average is a
// linear sample half a texel off.
struct FaceVelocities {
    vec3 x, y, z;
};

vec2 inside_slab(vec2 s) {
    return clamp(s, vec2(0.5), vec2(FACES.size.xy) - 0.5);
}

FaceVelocities velocity_on_faces(sampler2D velocity, ivec3 c, vec3 own) {
    vec2 s = vec2(c.xy) + 0.5;
    vec2 left = inside_slab(s - vec2(0.5, 0.0)), right = inside_slab(s + vec2(0.5, 0.0));
    vec2 down = inside_slab(s - vec2(0.0, 0.5)), up = inside_slab(s + vec2(0.0, 0.5));
    int above = min(c.z + 1, FACES.size.z - 1), below = max(c.z - 1, 0);
    FaceVelocities f;
    f.x = vec3(own.x, sample_slab(velocity, FACES, inside_slab(s + vec2(-0.5, 0.5)), c.z).y,
               0.5 * (sample_slab(velocity, FACES, left, c.z).z + sample_slab(velocity, FACES, left, above).z));
    f.y = vec3(sample_slab(velocity, FACES, inside_slab(s + vec2(0.5, -0.5)), c.z).x, own.y,
               0.5 * (sample_slab(velocity, FACES, down, c.z).z + sample_slab(velocity, FACES, down, above).z));
    f.z = vec3(0.5 * (sample_slab(velocity, FACES, right, c.z).x + sample_slab(velocity, FACES, right, below).x),
               0.5 * (sample_slab(velocity, FACES, up, c.z).y + sample_slab(velocity, FACES, up, below).y), own.z);
    return f;
}
