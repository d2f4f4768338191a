// advect_smoke.frag     s = s(x - dt u) exp(-k dt) + dt q
//
// reads   velocity   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// reads   smoke      R32F     Cells (nx, ny, nz)         [1]
// writes  s          R32F     Cells                      [1]
// fetches 6
#include "velocity.glsl"
#include "sources.glsl"
#include "beyond.glsl"

uniform sampler2D velocity, smoke;
uniform float dt_h;     // dt / h  [s/m]
uniform float remains;  // exp(-k dt)

out float result;

void main() {
    ivec3 c = cell_here(TARGET);
    vec3 x = vec3(c) + 0.5;
    vec3 s = x - dt_h * velocity_in_cell(velocity, c);
    result = remains * from_inside(s) * sample_linear(smoke, TARGET, s).x + from_sources(x);
}
