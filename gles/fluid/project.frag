// project.frag     u = u* - grad phi;  u = u_solid where nothing flows;  u.n = 0 at the tank's walls
//
// reads   velocity    RGBA32F  Faces (nx+1, ny+1, nz+1)    [m/s]
// reads   phi         RGBA32F  Cells4 (nx, ny, nz)         [m/s]
// reads   ax, ay, az  RGBA32F  Faces4                      variant CUT
// writes  u           RGBA32F  Faces                       [m/s]
// fetches 5, CUT 8, WALLS 15, CUT+WALLS 24
//
// Variants: plain away from solids; CUT near them; WALLS for the layers at the upper walls, where components that own no
// face there repeat their neighbour (velocity.glsl).
uniform sampler2D velocity, phi;
#ifdef CUT
uniform sampler2D ax, ay, az;
#endif

out vec4 result;

float lane(vec4 four, int z) {
    return dot(four, vec4(equal(ivec4(z & 3), ivec4(0, 1, 2, 3))));
}

float potential(ivec3 c) {
    c = clamp(c, ivec3(0), CELLS - 1);
    return lane(at(phi, PHI, ivec3(c.xy, c.z >> 2)), c.z);
}

float fraction(sampler2D a, ivec3 c) {
    return lane(at(a, FRACTION, ivec3(c.xy, c.z >> 2)), c.z);
}

// The three components of one texel. At a wall both potentials are the same, and the mask does the rest.
vec3 projected(ivec3 c) {
    float p = potential(c);
    vec3 u = at(velocity, FACES, c).xyz;
    u -= p - vec3(potential(c - ivec3(1, 0, 0)), potential(c - ivec3(0, 1, 0)), potential(c - ivec3(0, 0, 1)));
#ifdef CUT
    vec3 a = vec3(fraction(ax, c), fraction(ay, c), fraction(az, c));
    vec3 x = vec3(c);
    vec3 solid = vec3(solid_velocity(x + vec3(0.0, 0.5, 0.5)).x, solid_velocity(x + vec3(0.5, 0.0, 0.5)).y,
                      solid_velocity(x + vec3(0.5, 0.5, 0.0)).z);
    u = mix(u, solid, vec3(lessThanEqual(a, vec3(0.0))));
#endif
    return u * vec3(greaterThan(c, ivec3(0))) * vec3(lessThan(c, CELLS));
}

void main() {
    ivec3 c = cell_here(TARGET);
#ifdef WALLS
    ivec3 m = min(c, CELLS - 1);
    result = vec4(projected(ivec3(c.x, m.yz)).x, projected(ivec3(m.x, c.y, m.z)).y, projected(ivec3(m.xy, c.z)).z, 0.0);
#else
    result = vec4(projected(c), 0.0);
#endif
}
