// put_pressure_right.frag     phi -= mean of phi; and a fifth of what is beyond L |grad phi|_4
//
// reads   phi   RGBA32F  Cells4 (nx, ny, nz)   [m/s]
// reads   sum   RGBA32F, one texel: (sum of phi over all cells, of |grad phi|^4, 0, 0)
// writes  phi   RGBA32F  Cells4                [m/s]
// fetches 2
//
// The mean only in closed tanks. |grad phi|_4 is the gradient's fourth root of its mean fourth power. L: as far as an even gradient
// over the whole tank takes phi from 0, half the diagonal in a closed tank, the longest side from an opening; what is around a body of
// any size stays below.
#include "guard.glsl"

uniform sampler2D phi, sum;
uniform float most_phi;

out vec4 result;

void main() {
    vec4 p = sound(texelFetch(phi, ivec2(gl_FragCoord.xy), 0), most_phi);
    vec2 means = texelFetch(sum, ivec2(0), 0).xy / float(CELLS.x * CELLS.y * CELLS.z);
#ifdef CLOSED
    p -= means.x;  // guard level
    float cells = 0.5 * length(vec3(CELLS));
#else
    float cells = float(max(max(CELLS.x, CELLS.y), CELLS.z));
#endif
    float reach = cells * sqrt(sqrt(means.y));
    result = p - 0.2 * (p - clamp(p, -reach, reach));  // guard pocket_level
}
