// put_pressure_right.frag     phi -= mean of phi
//
// reads   phi   RGBA32F  Cells4 (nx, ny, nz)   [m/s]
// reads   sum   RGBA32F, one texel: (sum of phi over all cells, 0, 0, 0)
// writes  phi   RGBA32F  Cells4                [m/s]
// fetches 2
#include "guard.glsl"

uniform sampler2D phi, sum;
uniform float most_phi;

out vec4 result;

void main() {
    float mean = texelFetch(sum, ivec2(0), 0).x / float(CELLS.x * CELLS.y * CELLS.z);
    result = sound(texelFetch(phi, ivec2(gl_FragCoord.xy), 0), most_phi) - mean;  // guard level
}
