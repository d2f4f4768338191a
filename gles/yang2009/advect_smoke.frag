// advect_smoke.frag     s = s(x - dt u) exp(-k dt) + dt q    Crane, Llamas & Tariq 2007, ch. 30
//
// reads   velocity   RGBA32F  Cells (nx, ny, nz)    [m/s]
// reads   smoke      R32F     Cells                 [1]
// writes  s          R32F     Cells                 [1]
// fetches 3
//
// Variant FADES: k is not 0.
#include "fluid/sources.glsl"
#include "guard.glsl"

uniform sampler2D velocity, smoke;
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
    vec3 moved = sound(dt_h * at(velocity, TARGET, c).xyz, FARTHEST);                  // guard carrier
    float carried = sound(sample_linear(smoke, TARGET, x - moved).x, kMostScalar);     // guard scalar
    result = remains * carried + from_sources(x);
}
