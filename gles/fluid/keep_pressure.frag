// keep_pressure.frag     phi = scale phi, as far as a step may start from it
//
// reads   phi    RGBA32F  Cells4 (nx, ny, nz)   [m/s]   of the last step
// writes  phi    RGBA32F  Cells4                [m/s]
// fetches 1
#include "guard.glsl"

uniform sampler2D phi;
uniform float scale;  // phi ~ dt p, and the step may be of another length than the last
uniform float most_phi;

out vec4 result;

void main() {
    result = scale * kept(texelFetch(phi, ivec2(gl_FragCoord.xy), 0), most_phi);  // guard guess
}
