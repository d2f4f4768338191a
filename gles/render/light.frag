// light.frag     T(x) = V(x) exp(-sigma int s dl)     from x towards the key light, and towards the fill light
//
// reads   smoke   R32F    Cells (nx, ny, nz)            [1]       variant SMOKE
// reads   the bodies' shapes and poses (uniforms)       [cells]   variant BODY
// writes  T       RG32F   Cells of half the grid        r: of the key light, g: of the fill light; 0 none .. 1 all arrives
// fetches 64
//
// V is what the bodies let pass: 0 .. 1 across a penumbra that widens with the distance from the body.
#include "ray.glsl"

uniform sampler2D smoke;
uniform vec3 to_key, to_fill;  // unit vectors towards the lights
uniform float extinction;      // sigma  [1/cell]

out vec2 result;

#ifdef BODY
// A cell inside a body takes the light of the point on its surface: the surface's colour is interpolated from both sides.
vec3 outside(vec3 x) {
    float distance = solid_distance(x);
    return distance < 1.0 ? x + (1.0 - distance) * body_normal(x) : x;
}

// `softness`: width of the penumbra over the distance from the body.
float past_bodies(vec3 x, vec3 to_light, float end, float softness) {
    float open = 1.0;
    float t = 1.0;
    for (int i = 0; i < 24 && t < end && open > 0.0; ++i) {
        float distance = solid_distance(x + t * to_light);
        open = min(open, 0.5 + distance / (1.0 + softness * t));
        t += clamp(distance, 0.5, 8.0);
    }
    return smoothstep(0.0, 1.0, open);
}
#endif

#ifdef SMOKE
float past_smoke(vec3 x, vec3 to_light, float end, int steps) {
    float stretch = end / float(steps);
    float amount = 0.0;
    for (int i = 0; i < steps; ++i)
        amount += sample_linear(smoke, SMOKE_CELLS, x + (float(i) + 0.5) * stretch * to_light).x;
    return exp(-extinction * stretch * amount);
}
#endif

void main() {
    vec3 x = 2.0 * vec3(cell_here(TARGET)) + 1.0;
#ifdef BODY
    x = outside(x);
#endif
    vec2 end = max(vec2(tank_span(x, to_key).y, tank_span(x, to_fill).y), 0.0);
    result = vec2(1.0);
#ifdef BODY
    result *= vec2(past_bodies(x, to_key, end.x, 0.12), past_bodies(x, to_fill, end.y, 0.8));
#endif
#ifdef SMOKE
    result *= vec2(past_smoke(x, to_key, end.x, 20), past_smoke(x, to_fill, end.y, 12));
#endif
}
