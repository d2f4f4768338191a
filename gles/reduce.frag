// reduce.frag     A block of BLOCK x BLOCK texels becomes one
//
// reads   field    any float texture of SOURCE_SIZE texels
// writes  result   RGBA32F    sum, or with MASK: max where the mask is 1 (max, sum, sum, max -> vec4(1, 0, 0, 1))
// fetches 64
uniform sampler2D field;
uniform ivec3 shift;  // the target texel that block (0, 0) goes to; z unused

out vec4 result;

void main() {
    ivec2 first = (ivec2(gl_FragCoord.xy) - shift.xy) * BLOCK;
    vec4 sum = vec4(0.0), most = vec4(0.0);
    ivec2 last = min(first + BLOCK, SOURCE_SIZE);
    for (int y = first.y; y < last.y; ++y)
        for (int x = first.x; x < last.x; ++x) {
            vec4 v = texelFetch(field, ivec2(x, y), 0);
            sum += v;
            most = max(most, v);
        }
#ifdef MASK
    result = mix(sum, most, MASK);
#else
    result = sum;
#endif
}
