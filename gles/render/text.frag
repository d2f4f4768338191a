// text.frag     c = page + (1 - alpha) c     a page of words and boxes, laid over the picture
//
// reads   page    RGBA8  its own pixels, first row at the top    display values times alpha, alpha
// writes  colour  RGBA8  pixels of the picture                   the page's; blended as above (Onto::Over)
// fetches 1
uniform sampler2D page;
uniform vec2 corner;  // the page's upper left, from the picture's  [px]

out vec4 colour;

void main() {
    vec2 from_top = vec2(gl_FragCoord.x, float(TARGET.size.y) - gl_FragCoord.y);
    colour = texelFetch(page, ivec2(floor(from_top - corner)), 0);
}
