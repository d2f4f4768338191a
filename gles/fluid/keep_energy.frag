// keep_energy.frag     u* = u* min(1, sqrt(sum |u|^2 / sum |u*|^2))
//
// reads   velocity   RGBA32F  Faces   [m/s]
// reads   energy     RGBA32F, one texel: (sum |u|^2, sum |u*|^2, 0, 0)
// writes  u*         RGBA32F  Faces   [m/s]
// fetches 2
uniform sampler2D velocity, energy;

out vec4 result;

void main() {
    vec2 sums = texelFetch(energy, ivec2(0), 0).xy;
    float slower = sums.y > sums.x ? sqrt(sums.x / sums.y) : 1.0;
    result = slower * texelFetch(velocity, ivec2(gl_FragCoord.xy), 0);
}
