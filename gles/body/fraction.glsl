// fraction.glsl     How much of a unit cube lies outside a solid, from one distance: the volume cut by a plane.
//
// The staggered cell of a face is a cube of edge 1 cell around the face centre. The solid's surface is taken as the plane
// at signed distance `distance` (positive outside) with normal `n`. The volume of {x in [0,1]^3 : n.x < alpha} is the
// inclusion-exclusion sum of clamped cubes over 6 n1 n2 n3 (Scardovelli & Zaleski 2000, J. Comput. Phys. 164, eq. 6
// for the general case). Volume rather than area fractions: Batty, Bertails & Bridson 2007.

const float kSliver = 1e-4;

// Components of the normal are not let below this. For a face along the grid the fraction would otherwise have a kink
// where the surface passes a cell's edge, and a body gliding by would be felt to tick once a cell
// (tests/physics/ripple_test.cpp measures that; change this and run it). It is one more box filter across the surface;
// larger values smooth more and lower the added mass (tests/physics/added_mass_test.cpp).
const float kLeastNormal = 0.3;

// n: |components| of the unit normal.
float fluid_fraction(float distance, vec3 n) {
    n = max(abs(n), vec3(kLeastNormal));
    float alpha = distance + 0.5 * (n.x + n.y + n.z);
    vec3 one = max(alpha - n, 0.0);
    vec3 two = max(alpha - n.yzx - n.zxy, 0.0);
    float all = max(alpha - n.x - n.y - n.z, 0.0);
    float a = max(alpha, 0.0);
    float volume = (a * a * a - dot(one * one, one) + dot(two * two, two) - all * all * all) / (6.0 * n.x * n.y * n.z);
    return volume;
}

// The fluid's share of a cube of this edge around x [cells].
float fluid_fraction_at(vec3 x, float edge) {
    float distance = solid_distance(x) / edge;
    // Where the surface is farther than the cube's half diagonal, no gradient is needed (nor defined, at a centre).
    if (abs(distance) > 1.0) return distance > 0.0 ? 1.0 : 0.0;
    vec2 e = vec2(0.25 * edge, 0.0);
    vec3 low = vec3(solid_distance(x - e.xyy), solid_distance(x - e.yxy), solid_distance(x - e.yyx)) / edge;
    vec3 high = vec3(solid_distance(x + e.xyy), solid_distance(x + e.yxy), solid_distance(x + e.yyx)) / edge;
    vec3 g = 2.0 * (high - low);
    float steepness = length(g);  // 1 for a true distance
    if (steepness < 1e-3) return distance > 0.0 ? 1.0 : 0.0;
    // A curved surface seen as a plane lies too far out: on average over the cube, distance exceeds that to the plane by
    // 1/24 of its Laplacian (the mean of a quadratic over a unit cube). Near an edge of the body the Laplacian only says so.
    float laplacian = 16.0 * (dot(low, vec3(1.0)) + dot(high, vec3(1.0)) - 6.0 * distance);
    distance += clamp(laplacian, -2.0, 2.0) / 24.0;
    return fluid_fraction(distance / steepness, g / steepness);
}

#ifdef THIN
vec3 away_from_solid(vec3 x) {
    const vec2 e = vec2(0.05, 0.0);
    return vec3(solid_distance(x + e.xyy) - solid_distance(x - e.xyy), solid_distance(x + e.yxy) - solid_distance(x - e.yxy),
                solid_distance(x + e.yyx) - solid_distance(x - e.yyx)) / (2.0 * e.x);
}

// 0 where a solid that is thinner than the cells parts the two cells beside a face, however little of them it fills: where it
// lies between their middles, and its surfaces there look opposite ways. 1 elsewhere.
float not_parted(vec3 x, vec3 axis) {
    // A little aside, for no cell's middle may lie exactly in that of a plate.
    vec3 low = x - 0.5 * axis + vec3(1e-3, 7e-4, 4e-4);
    vec3 n_low = away_from_solid(low), n_high = away_from_solid(low + axis);
    float fall = -dot(n_low, axis), rise = dot(n_high, axis);
    // By more than 120 degrees: at an edge, surfaces that meet at right angles part nothing.
    if (dot(n_low, n_high) >= -0.5 * length(n_low) * length(n_high) || fall <= 0.0 || rise <= 0.0) return 1.0;
    // Where the surfaces' tangent planes meet on the way lies the middle of a plate, or the open side of its rim.
    float t = (solid_distance(low) - solid_distance(low + axis) + rise) / (fall + rise);
    return step(0.0, solid_distance(low + clamp(t, 0.0, 1.0) * axis));
}
#endif

// Farther than this from a surface [cells], with some room for distances that are not quite true, a staggered cell is wholly
// on one side of it: its corners are 0.87 from its middle.
const float kFar = 1.5;

// The fluid's share of the staggered cell around x [cells], from SUBCUBES^3 parts.
//
// What only cells beside a surface need stands in loops that are left at once elsewhere: rasterisers in software go through
// both sides of an `if`, but leave a loop that no fragment is in. All cells at full length cost ten times as much.
float fluid_fraction_at(vec3 x, vec3 axis) {
    float distance = solid_distance(x);
    bool is_near = abs(distance) <= kFar;
    float volume = is_near || distance <= 0.0 ? 0.0 : 1.0;
    int layers = is_near ? SUBCUBES : 0;
#if SUBCUBES == 1
    for (int k = 0; k < layers; ++k) volume = fluid_fraction_at(x, 1.0);
#else
    const float edge = 1.0 / float(SUBCUBES);
    for (int k = 0; k < layers; ++k)
        for (int j = 0; j < SUBCUBES; ++j)
            for (int i = 0; i < SUBCUBES; ++i)
                volume += edge * edge * edge * fluid_fraction_at(x - 0.5 + (vec3(i, j, k) + 0.5) * edge, edge);
#endif
    // Slivers that rounding alone could open or close count as closed.
    volume = volume < kSliver ? 0.0 : min(volume, 1.0);
#ifdef THIN
    int cut = volume > 0.0 && volume < 1.0 ? 1 : 0;
    for (int n = 0; n < cut; ++n) volume *= not_parted(x, axis);
#endif
    return volume;
}
