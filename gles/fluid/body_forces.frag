// body_forces.frag     u += dt (g (1 + w s - beta T) + f)
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// reads   smoke      R32F     Cells (nx, ny, nz)         [1]     variant WEIGHT: s, with its weight w (Boussinesq)
// reads   temperature R32F    Cells                      [K]     variant LIFT: T, with the expansion beta of the fluid
// writes  u          RGBA32F  Faces                      [m/s]
// fetches 1, WEIGHT 5, LIFT 5, WEIGHT+LIFT 9
//
// WEIGHT and LIFT come with GRAVITY. Variant FORCING has the scene's own f(x, t) [m/s^2] in front of it.
uniform sampler2D velocity;
uniform float dt;  // [s]
#ifdef GRAVITY
uniform vec3 gravity;  // [m/s^2]
#endif
#ifdef WEIGHT
uniform sampler2D smoke;
uniform float weight;
#endif
#ifdef LIFT
uniform sampler2D temperature;
uniform float expansion;  // [1/K]
#endif

#if defined(WEIGHT) || defined(LIFT)
vec3 on_faces(sampler2D scalar, ivec3 c) {
    // The mean of the cells at either side.
    return 0.5 * (at_clamped(scalar, CELL_CENTRES, c).x +
                  vec3(at_clamped(scalar, CELL_CENTRES, c - ivec3(1, 0, 0)).x,
                       at_clamped(scalar, CELL_CENTRES, c - ivec3(0, 1, 0)).x,
                       at_clamped(scalar, CELL_CENTRES, c - ivec3(0, 0, 1)).x));
}
#endif

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 acceleration = vec3(0.0);
#ifdef GRAVITY
    vec3 density = vec3(1.0);  // relative, of the fluid on the three faces of this texel
#ifdef WEIGHT
    density += weight * on_faces(smoke, c);
#endif
#ifdef LIFT
    density -= expansion * on_faces(temperature, c);
#endif
    acceleration = gravity * density;
#endif
#ifdef FORCING
    vec3 x = vec3(c);
    acceleration += vec3(forcing(x + vec3(0.0, 0.5, 0.5)).x, forcing(x + vec3(0.5, 0.0, 0.5)).y,
                         forcing(x + vec3(0.5, 0.5, 0.0)).z);
#endif
    result = at(velocity, TARGET, c) + vec4(dt * acceleration, 0.0);
}
