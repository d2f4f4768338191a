// viscous_restrict.frag     r_coarse = mean of the fine r around a coarse face: (1/4, 1/2, 1/4) along its axis, (1/2, 1/2) across
//
// reads   residual    RGBA32F  Faces of the FINE grid     [m/s]
// writes  r_coarse    RGBA32F  Faces of the coarse grid   [m/s]
// fetches 36
uniform sampler2D residual;

out vec4 result;

// Fine faces beyond the grid count as nothing.
vec4 fine(ivec3 f) {
    return all(greaterThanEqual(f, ivec3(0))) && all(lessThan(f, FINE.size)) ? at(residual, FINE, f) : vec4(0.0);
}

void main() {
    ivec3 f = 2 * cell_here(FACES);
    result = vec4(0.0);
    for (int along = -1; along <= 1; ++along)
        for (int t = 0; t < 4; ++t) {
            int p = t & 1, q = t >> 1;
            float w = (along == 0 ? 0.5 : 0.25) * 0.25;
            result.x += w * fine(f + ivec3(along, p, q)).x;
            result.y += w * fine(f + ivec3(p, along, q)).y;
            result.z += w * fine(f + ivec3(p, q, along)).z;
        }
}
