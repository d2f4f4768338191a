// viscous_prolong.frag     u += linear(u_coarse)
//
// reads   velocity    RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// reads   correction  RGBA32F  Faces of the COARSE grid   [m/s]
// reads   shares      RGBA32F  Faces                      of fluid   variant CUT: faces in bodies stay as they are
// writes  u           RGBA32F  Faces                      [m/s]
// fetches 7, CUT 8
uniform sampler2D velocity, correction;
#ifdef CUT
uniform sampler2D shares;
#endif

out vec4 result;

// Coarse faces sit on every second fine one along their axis; across, a coarse texel spans two fine ones.
vec3 coarse_position(ivec3 c, vec3 along) {
    vec3 across = min((vec3(c) + 0.5) * 0.5, vec3(COARSE.size) - 1.5);
    return mix(across, vec3(c) * 0.5 + 0.5, along);
}

void main() {
    ivec3 c = cell_here(FACES);
    vec3 low = vec3(lessThanEqual(c, ivec3(0))), high = vec3(greaterThanEqual(c, CELLS));
#ifdef THROUGH
    low *= 1.0 - min(OPEN_LOW, 1.0);
    high *= 1.0 - min(OPEN_HIGH, 1.0);
#endif
    vec3 moves = (1.0 - low) * (1.0 - high);
    // Texels of the upper layers hold one wall face and copies.
    for (int axis = 0; axis < 3; ++axis)
        if (c[axis] >= CELLS[axis]) moves *= vec3(equal(ivec3(axis), ivec3(0, 1, 2)));
#ifdef CUT
    moves *= vec3(greaterThan(at(shares, FACES, c).xyz, vec3(0.0)));
#endif
    result = at(velocity, FACES, c);
    result.x += moves.x * sample_linear(correction, COARSE, coarse_position(c, vec3(1.0, 0.0, 0.0))).x;
    result.y += moves.y * sample_linear(correction, COARSE, coarse_position(c, vec3(0.0, 1.0, 0.0))).y;
    result.z += moves.z * sample_linear(correction, COARSE, coarse_position(c, vec3(0.0, 0.0, 1.0))).z;
}
