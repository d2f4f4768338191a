// maccormack.glsl     phi = phi^ + (phi - phi~) / 2, kept within the values that phi^ was interpolated from
//
// Selle, Fedkiw, Kim, Liu, Rossignac 2008, "An unconditionally stable MacCormack method": phi^ is traced forward, phi~
// traced back from phi^; half their error is taken out. The limiter makes it stable and free of new extremes.
#include "guard.glsl"

// Least and greatest of the up to eight values around s (cells, centres at +1/2), all channels; `bits`: the greatest bits but the
// sign's. min and max of what is no number are anything; those of integers are not.
void donors(sampler2D field, const Layout l, vec3 s, out vec4 least, out vec4 most, out uvec4 bits) {
    vec3 p = clamp(s, vec3(0.5), vec3(l.size) - 0.5) - 0.5;
    ivec3 low = ivec3(p), high = ivec3(ceil(p));  // the same where a neighbour has no weight, so no side is preferred
    ivec2 below = texel_of(l, ivec3(0, 0, low.z)), above = texel_of(l, ivec3(0, 0, high.z));
    vec4 a = texelFetch(field, below + low.xy, 0), b = texelFetch(field, below + ivec2(high.x, low.y), 0);
    vec4 c = texelFetch(field, below + ivec2(low.x, high.y), 0), d = texelFetch(field, below + high.xy, 0);
    vec4 e = texelFetch(field, above + low.xy, 0), f = texelFetch(field, above + ivec2(high.x, low.y), 0);
    vec4 g = texelFetch(field, above + ivec2(low.x, high.y), 0), h = texelFetch(field, above + high.xy, 0);
    least = min(min(min(a, b), min(c, d)), min(min(e, f), min(g, h)));
    most = max(max(max(a, b), max(c, d)), max(max(e, f), max(g, h)));
    bits = max(max(max(bits_of(a), bits_of(b)), max(bits_of(c), bits_of(d))), max(max(bits_of(e), bits_of(f)), max(bits_of(g), bits_of(h))));
}

// Between the two. Where a donor is nothing a field can hold nothing limits, and phi^ stays as it is.
float limited(float phi, float forward, float least, float most, uint bits, float most_sound) {
    return bits > floatBitsToUint(most_sound) ? forward : clamp(phi, least, most);  // guard donors
}
