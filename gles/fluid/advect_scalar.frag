// advect_scalar.frag     s = s(x - dt u) exp(-k dt) + dt q
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// reads   scalar     R32F     Cells (nx, ny, nz)         s, in its own unit
// writes  s          R32F     Cells
// fetches 6
//
// Variant FADES: k is not 0.
#include "velocity.glsl"
#include "sources.glsl"
#include "beyond.glsl"
#include "guard.glsl"

uniform sampler2D velocity, scalar;
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
    vec3 s = x - sound(dt_h * velocity_in_cell(velocity, c), FARTHEST);                  // guard carrier
    float carried = sound(from_inside(s) * sample_linear(scalar, TARGET, s).x, kMostScalar);  // guard scalar
    result = remains * carried + from_sources(x);
}
