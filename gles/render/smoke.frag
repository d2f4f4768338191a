// smoke.frag     k = int T sigma s L dt,  T = exp(-sigma int s dt)     along each pixel's ray through the tank
//
// reads   smoke   RG32F    Cells (nx, ny, nz)        two layers of s, see pair_smoke.frag
// reads   light   RGBA32F  Cells of half the grid    two layers of L of the two lights, see pair_light.frag
// writes  front   RGBA16F  pixels, maybe half        r, g: k of key and fill light, a: T; up to the body, or about where
//                                                    the ray comes nearest to it; far from it, everything
// writes  behind  RGBA16F  the same                  the rest of the ray    variant BODY
// fetches 120
//
// Two layers, so that the picture can decide for each of its own pixels, finer than these, whether the body hides what
// is behind it; neither has a jump anywhere, so that both can be interpolated.
#include "ray.glsl"

uniform sampler2D smoke, light;
uniform vec3 eye;           // [cells]
uniform mat3 rays;          // see Camera
uniform float extinction;   // sigma  [1/cell]
uniform float step_length;  // [cells]

layout(location = 0) out vec4 front;
#ifdef BODY
layout(location = 1) out vec4 behind;
#endif

const float kUsedUp = 0.004;  // below half a step of an 8-bit picture

float smoke_at(vec3 x) {
    x = clamp(x, vec3(0.5), vec3(SMOKE_CELLS.size) - 0.5);
    float z = floor(x.z - 0.5);
    vec2 s = sample_slab(smoke, SMOKE_CELLS, x.xy, int(z)).xy;
    return mix(s.x, s.y, x.z - 0.5 - z);
}

vec2 light_at(vec3 x) {
    x = clamp(0.5 * x, vec3(0.5), vec3(LIGHT.size) - 0.5);
    float z = floor(x.z - 0.5);
    vec4 l = sample_slab(light, LIGHT, x.xy, int(z));
    return mix(l.xz, l.yw, x.z - 0.5 - z);
}

// The middle of each step is sampled. The first step is cut short by a different amount in each pixel, so that what the
// steps miss is noise and not bands.
vec4 march(vec3 d, float from, float to, float noise) {
    vec2 scattered = vec2(0.0);
    float left = 1.0;
    float end = from + noise * step_length;
    while (from < to && left > kUsedUp) {
        end = min(end, to);
        vec3 x = eye + 0.5 * (from + end) * d;
        float passes = exp(-extinction * (end - from) * smoke_at(x));
        scattered += left * (1.0 - passes) * light_at(x);
        left *= passes;
        from = end;
        end += step_length;
    }
    return vec4(scattered, 0.0, left);
}

void main() {
    vec3 d = normalize(rays * vec3(2.0 * gl_FragCoord.xy * TARGET.texel - 1.0, 1.0));
    vec2 span = tank_span(eye, d);
    float noise = pixel_noise() + 0.01;
#ifdef BODY
    vec2 met = meet_body(eye, d, span);
    float middle = mix(met.x, span.y, smoothstep(1.0, 5.0, met.y));
    front = march(d, span.x, middle, noise);
    behind = march(d, middle, front.a > kUsedUp ? span.y : middle, noise);
#else
    front = march(d, span.x, span.y, noise);
#endif
}
