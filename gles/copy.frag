// copy.frag     result = field
//
// reads   field    any
// writes  result   the same layout
// fetches 1
uniform sampler2D field;

out vec4 result;

void main() {
    result = texelFetch(field, ivec2(gl_FragCoord.xy), 0);
}
