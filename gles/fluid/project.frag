// project.frag     u = u* - grad phi;  u = u_solid where nothing flows;  walls: u.n = 0, or what flows in, or -grad phi
//
// reads   velocity    RGBA32F  Faces (nx+1, ny+1, nz+1)    [m/s]
// reads   phi         RGBA32F  Cells4 (nx, ny, nz)         [m/s]
// reads   ax, ay, az  RGBA32F  Faces4                      variant CUT
// writes  u           RGBA32F  Faces                       [m/s]
// fetches 5, CUT 8, WALLS 15, CUT+WALLS 24
//
// In the layers at the upper walls components that own no face there repeat their neighbour (velocity.glsl).
// Variants: plain away from solids; CUT near them; THROUGH where walls let fluid through (walls.h), with WALLS for those layers;
// PREDICTS where a viscous step starts with the pressure of the last one.
uniform sampler2D velocity, phi;
#ifdef PREDICTS
#include "guard.glsl"
uniform float scale;  // of phi: the last step's, when it serves for this one
uniform float most_phi;
#else
const float scale = 1.0;
#endif
#ifdef CUT
uniform sampler2D ax, ay, az;
uniform float through_gaps;  // [m/s]

// A gap narrower than this share of a face is no longer told from a closed one that leaks.
const float kGap = 0.25;
#endif

out vec4 result;

float potential(ivec3 c) {
    c = clamp(c, ivec3(0), CELLS - 1);
    float p = lane(at(phi, PHI, ivec3(c.xy, c.z >> 2)), c.z);
#ifdef PREDICTS
    p = kept(vec4(p), most_phi).x;  // guard guess
#endif
    return scale * p;
}

#ifdef CUT
// Next to a solid: what passes through gaps is slowed down, and what does not pass at all is the solid's.
vec3 beside(vec3 solid, vec3 u, ivec3 c) {
    ivec3 slab = ivec3(c.xy, c.z >> 2);
    vec3 a = vec3(lane(at(ax, FRACTION, slab), c.z), lane(at(ay, FRACTION, slab), c.z), lane(at(az, FRACTION, slab), c.z));
    vec3 slower = clamp(u, solid - through_gaps, solid + through_gaps);
    u = mix(u, slower, lessThan(a, vec3(kGap)));  // guard gap
    return mix(u, solid, lessThanEqual(a, vec3(0.0)));
}
#endif

// Those components of one texel that c owns: all but at upper walls, where it owns the one through the wall. `m` is the cell
// whose faces they are. At a wall both potentials are the same, and the mask does the rest.
vec3 projected(ivec3 c, ivec3 m) {
    float p = potential(m);
    vec3 u = at(velocity, FACES, m).xyz;
    u -= p - vec3(potential(m - ivec3(1, 0, 0)), potential(m - ivec3(0, 1, 0)), potential(m - ivec3(0, 0, 1)));
    vec3 low = vec3(lessThanEqual(c, ivec3(0))), high = vec3(greaterThanEqual(c, CELLS));
#ifdef THROUGH
    u -= p * (low * OPEN_LOW - high * OPEN_HIGH);
#endif
#ifdef CUT
    vec3 x = vec3(m);
    vec3 solid = vec3(solid_velocity(x + vec3(0.0, 0.5, 0.5)).x, solid_velocity(x + vec3(0.5, 0.0, 0.5)).y,
                      solid_velocity(x + vec3(0.5, 0.5, 0.0)).z);
    u = beside(solid, u, m);
#endif
#ifdef THROUGH
    vec3 inflow = low * INFLOW_LOW + high * INFLOW_HIGH;
    ivec3 wall = ivec3(0, 2, 4) + ivec3(high);
    vec3 of_wall = vec3(wall_velocity(wall.x, vec3(c) + vec3(0.0, 0.5, 0.5)).x,
                        wall_velocity(wall.y, vec3(c) + vec3(0.5, 0.0, 0.5)).y,
                        wall_velocity(wall.z, vec3(c) + vec3(0.5, 0.5, 0.0)).z);
    vec3 closed = low * (1.0 - min(OPEN_LOW, 1.0)) + high * (1.0 - min(OPEN_HIGH, 1.0));
    return mix(u, inflow * of_wall, closed);
#else
    return u * (1.0 - low) * (1.0 - high);
#endif
}

void main() {
    ivec3 c = cell_here(TARGET), m = min(c, CELLS - 1);
#ifdef WALLS
    ivec3 x = ivec3(c.x, m.yz), y = ivec3(m.x, c.y, m.z), z = ivec3(m.xy, c.z);
    result = vec4(projected(x, x).x, projected(y, y).y, projected(z, z).z, 0.0);
#else
    result = vec4(projected(c, m), 0.0);
#endif
}
