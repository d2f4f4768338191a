// picture.frag     The room, the tank, the bodies in it and the smoke around them, as the eye sees them.
//
// reads   light          RG32F    Cells of half the grid    key and fill light that arrive, 0 .. 1
// reads   front, behind  RGBA16F  pixels, maybe half        see smoke.frag   variant SMOKE
// reads   the bodies' shapes and poses (uniforms)           [cells]          variant BODY
// writes  colour         RGBA8    pixels                    display values, gamma 2.2
// fetches 6
#include "ray.glsl"

uniform sampler2D light, front, behind;
uniform vec3 eye;              // [cells]
uniform mat3 rays;             // see Camera
uniform vec3 to_key, to_fill;  // unit vectors towards the lights
uniform vec3 smoke_colour, background_colour;
uniform float exposure;
uniform float pixel_angle;  // of one pixel  [rad]

out vec4 colour;

const vec3 kKey = vec3(1.55, 1.2, 0.82);    // warm, from the upper left
const vec3 kFill = vec3(0.10, 0.19, 0.36);  // cool, from the other side
const vec3 kBody = vec3(0.95, 0.17, 0.05);
const vec3 kFloor = vec3(0.05, 0.05, 0.052);
const vec3 kGlass = vec3(0.30, 0.42, 0.50);

// Key and fill light that arrive at x.
vec2 light_at(vec3 x) {
    return sample_linear(light, LIGHT, 0.5 * x).xy;
}

// 1 within `width` of zero, falling to 0 over one pixel of size `pixel`; fades as the line gets thinner than a pixel.
float line(float distance, float width, float pixel) {
    float blur = max(pixel, 1e-4);
    return clamp((width - distance) / blur + 0.5, 0.0, 1.0) * min(1.0, 2.0 * width / blur);
}

// The room behind everything: dark, with a faint glow behind the tank.
vec3 room(vec3 d) {
    vec3 to_tank = normalize(0.5 * vec3(CELLS) - eye);
    float off = 1.0 - dot(d, to_tank);
    return background_colour * (0.10 + 0.55 * exp(-22.0 * off));
}

// The table the tank stands on, y = 0: a pool of key light, shadows of what is in the tank, a grid within the tank.
vec3 table(vec3 x, float t, vec3 d) {
    vec3 size = vec3(CELLS);
    vec2 from_middle = (x.xz - 0.5 * size.xz) / length(size);
    // Outside the tank, light arrives as it does where the ray towards it enters the tank, if it does.
    vec2 span = tank_span(x, to_key);
    float lit = span.x < span.y ? light_at(x + span.x * to_key).x : 1.0;
    vec3 c = kFloor * (kKey * max(to_key.y, 0.0) * lit * exp(-5.0 * dot(from_middle, from_middle)) + kFill);
    if (all(greaterThanEqual(x.xz, vec2(0.0))) && all(lessThanEqual(x.xz, size.xz))) {
        float pitch = size.x / 8.0;
        vec2 to_line = abs(fract(x.xz / pitch + 0.5) - 0.5) * pitch;
        float pixel = t * pixel_angle;
        vec2 stretched = vec2(pixel) * mix(vec2(1.0), vec2(1.0 / max(-d.y, 0.05)), abs(d.xz));
        float grid = max(line(to_line.x, 0.05, stretched.x), line(to_line.y, 0.05, stretched.y));
        c += 0.35 * grid * kGlass * (0.25 + lit);
    }
    float depth = length(from_middle);
    return mix(c, room(d), 1.0 - exp(-0.9 * depth * depth));
}

#ifdef BODY
vec3 body(vec3 x, vec3 d) {
    vec3 n = body_normal(x);
    vec2 lit = light_at(x + n + 2.0 * to_key);             // clear of the body's own shadow, which its normal gives
    float wrapped = max(0.8 * dot(n, to_key) + 0.2, 0.0);  // soft across the terminator, as by a large lamp
    float key = wrapped * wrapped * lit.x;
    float fill = (0.6 + 0.4 * dot(n, to_fill)) * (0.3 + 0.7 * lit.y);
    float rim = pow(1.0 - max(dot(n, -d), 0.0), 3.0);
    float gloss = pow(max(dot(n, normalize(to_key - d)), 0.0), 60.0) * lit.x;
    return kBody * (1.2 * kKey * key + (kFill + 0.2) * fill) + 0.35 * kKey * gloss + 1.5 * kFill * rim * fill;
}
#endif

// Edges of the tank where the ray along d crosses its surface at x, `pixel` cells wide there. The glass reaches one pixel
// beyond the fluid, so that the lines, drawn in its middle, are smooth on both sides.
float edges(vec3 x, vec3 d, float pixel) {
    vec3 to_face = min(x, vec3(CELLS) - x) + pixel;
    vec3 face = vec3(lessThanEqual(to_face, vec3(min(to_face.x, min(to_face.y, to_face.z)))));
    vec3 slant = d / max(dot(face, abs(d)), 0.02);
    vec3 blur = pixel * sqrt(1.0 + slant * slant);
    vec3 off = abs(to_face - pixel) + 1e3 * face;
    return max(line(off.x, 0.4 * pixel, blur.x), max(line(off.y, 0.4 * pixel, blur.y), line(off.z, 0.4 * pixel, blur.z)));
}

#ifdef SMOKE
// How strongly smoke that is lit along to_key shines along d: mostly forwards (Henyey & Greenstein 1941, g = 0.35), 1 on
// average.
float phase(vec3 d) {
    const float g = 0.35;
    float q = 1.0 + g * g - 2.0 * g * dot(d, to_key);
    return (1.0 - g * g) / (q * sqrt(q));
}

vec3 through(vec3 c, vec4 layer, vec3 d) {
    return c * layer.a + smoke_colour * (0.7 * kKey * phase(d) * layer.r + kFill * layer.g);
}
#endif

// From light to display values: a film curve (Narkowicz 2015, "ACES Filmic Tone Mapping Curve") and gamma.
vec3 displayed(vec3 c) {
    c *= exposure;
    c = c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14);
    return pow(clamp(c, 0.0, 1.0), vec3(1.0 / 2.2));
}

void main() {
    vec2 at_pixel = gl_FragCoord.xy * TARGET.texel;
    vec3 d = normalize(rays * vec3(2.0 * at_pixel - 1.0, 1.0));
    vec2 span = tank_span(eye, d);
    vec3 c = room(d);
    if (d.y < 0.0 && eye.y > 0.0) {
        float t = -eye.y / d.y;
        c = table(eye + t * d, t, d);
    }
    float pixel = pixel_angle * distance(eye, 0.5 * vec3(CELLS));
    vec2 glass = box_span(eye, d, vec3(-pixel), vec3(CELLS) + pixel);
    bool through_glass = glass.x < glass.y;
    if (through_glass) c += 0.5 * kGlass * edges(eye + glass.y * d, d, pixel);
#if defined(SMOKE) && defined(BODY)
    c = through(c, texture(behind, at_pixel), d);
#endif
#ifdef BODY
    // A miss by less than a pixel is a partial hit: a smooth silhouette.
    vec2 met = meet_body(eye, d, span);
    float covered = clamp(1.0 - (met.y - kTouch) / (met.x * pixel_angle), 0.0, 1.0);
    if (covered > 0.0) c = mix(c, body(eye + met.x * d, d), covered);
#endif
#ifdef SMOKE
    c = through(c, texture(front, at_pixel), d);
#endif
    if (through_glass) c += 0.5 * kGlass * edges(eye + glass.x * d, d, pixel);
    colour = vec4(displayed(c) + (pixel_noise() - 0.5) / 255.0, 1.0);
}
