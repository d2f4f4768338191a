// pair_light.frag     How bright smoke looks in the light that arrives, each layer beside the next (see pair_smoke.frag).
//
// reads   light   RG32F    Cells of half the grid    T of the key and of the fill light, see light.frag
// writes  pair    RGBA32F  the same                  r, g: key light scattered in this layer and the next; b, a: fill light
// fetches 2
//
// Light that is scattered more than once reaches deeper than light that is scattered once, so brightness is a sum of two
// powers of T: one falls off fast and models the near edge, one slowly and keeps the far side from going black (two
// octaves in the manner of Wrenninge, Kulla & Lundqvist 2013; powers and weights chosen by eye).
uniform sampler2D light;

out vec4 pair;

vec2 scattered(vec2 t) {
    return mix(pow(t, vec2(2.0)), pow(t, vec2(0.5)), 0.3);
}

void main() {
    ivec3 c = cell_here(TARGET);
    vec2 here = scattered(at(light, TARGET, c).xy);
    vec2 next = scattered(at_clamped(light, TARGET, c + ivec3(0, 0, 1)).xy);
    pair = vec4(here.x, next.x, here.y, next.y);
}
