// maccormack_scalar.frag     s = (s^ + (s - s~) / 2, limited) exp(-k dt) + dt q     second pass; s^ from advect_scalar.frag
//
// reads   velocity         RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// reads   scalar, forward  R32F     Cells (nx, ny, nz)         s and s^, in their own unit
// writes  s                R32F     Cells
// fetches 16
//
// Variant FADES: k is not 0.
#include "velocity.glsl"
#include "maccormack.glsl"
#include "sources.glsl"
#include "beyond.glsl"
#include "guard.glsl"

uniform sampler2D velocity, scalar, forward;
uniform float dt_h;  // dt / h  [s/m]
#ifdef FADES
uniform float remains;  // exp(-k dt)
#else
const float remains = 1.0;
#endif

out float result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 x = vec3(c) + 0.5;
    vec3 displacement = sound(dt_h * velocity_in_cell(velocity, c), FARTHEST);  // guard carrier
    vec4 least, most;
    uvec4 bits;
    donors(scalar, TARGET, x - displacement, least, most, bits);
    float back = sample_linear(forward, TARGET, x + displacement).x;
    // Where the way back leaves the tank through an opening nothing is known of the error.
    float ahead = at(forward, TARGET, c).x;
    float s = ahead + 0.5 * from_inside(x + displacement) * (at(scalar, TARGET, c).x - back);
    s = limited(s, ahead, least.x, most.x, bits.x, kMostScalar);
    float carried = sound(from_inside(x - displacement) * s, kMostScalar);  // guard scalar
    result = remains * carried + from_sources(x);
}
