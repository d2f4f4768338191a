// body_forces.frag     u += dt (g (1 + w s) + f + f_confinement)
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// reads   smoke      R32F     Cells (nx, ny, nz)         [1]     variant WEIGHT: s, with its weight w (Boussinesq)
// reads   swirl      RGBA32F  Cells                      [m/s^2] variant CONFINEMENT: confinement.frag
// writes  u          RGBA32F  Faces                      [m/s]
// fetches 1, WEIGHT 5, CONFINEMENT 5, WEIGHT+CONFINEMENT 9
//
// Variant FORCING has the scene's own f(x, t) [m/s^2] in front of it.
uniform sampler2D velocity;
uniform float dt;      // [s]
uniform vec3 gravity;  // [m/s^2]
#ifdef WEIGHT
uniform sampler2D smoke;
uniform float weight;

// Of the fluid on the three faces of this texel: the mean of the cells at either side.
vec3 excess(ivec3 c) {
    float s = at_clamped(smoke, CELL_CENTRES, c).x;
    return 0.5 * weight * (s + vec3(at_clamped(smoke, CELL_CENTRES, c - ivec3(1, 0, 0)).x,
                                    at_clamped(smoke, CELL_CENTRES, c - ivec3(0, 1, 0)).x,
                                    at_clamped(smoke, CELL_CENTRES, c - ivec3(0, 0, 1)).x));
}
#endif

#ifdef CONFINEMENT
uniform sampler2D swirl;

vec3 confinement(ivec3 c) {
    vec3 f = at_clamped(swirl, CELL_CENTRES, c).xyz;
    return 0.5 * (f + vec3(at_clamped(swirl, CELL_CENTRES, c - ivec3(1, 0, 0)).x,
                           at_clamped(swirl, CELL_CENTRES, c - ivec3(0, 1, 0)).y,
                           at_clamped(swirl, CELL_CENTRES, c - ivec3(0, 0, 1)).z));
}
#endif

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 acceleration = gravity;
#ifdef WEIGHT
    acceleration *= 1.0 + excess(c);
#endif
#ifdef FORCING
    vec3 x = vec3(c);
    acceleration += vec3(forcing(x + vec3(0.0, 0.5, 0.5)).x, forcing(x + vec3(0.5, 0.0, 0.5)).y,
                         forcing(x + vec3(0.5, 0.5, 0.0)).z);
#endif
#ifdef CONFINEMENT
    acceleration += confinement(c);
#endif
    result = at(velocity, TARGET, c) + vec4(dt * acceleration, 0.0);
}
