// add_halves.frag     sum = 2 first + second
//
// reads   first, second   RGBA32F   the same layout
// writes  sum             RGBA32F   the same
// fetches 2
//
// What the pressure of a whole step is, and what it does to the bodies (reflection.h).
uniform sampler2D first, second;

out vec4 result;

void main() {
    ivec2 t = ivec2(gl_FragCoord.xy);
    result = 2.0 * texelFetch(first, t, 0) + texelFetch(second, t, 0);
}
