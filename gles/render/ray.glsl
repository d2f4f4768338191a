// ray.glsl     Rays through the tank, which is the box 0 .. CELLS [cells].

// The piece of the ray o + t d that lies in the box low .. high; empty if x > y.
vec2 box_span(vec3 o, vec3 d, vec3 low, vec3 high) {
    vec3 reciprocal = 1.0 / (mix(vec3(-1.0), vec3(1.0), greaterThanEqual(d, vec3(0.0))) * max(abs(d), vec3(1e-6)));
    vec3 a = (low - o) * reciprocal;
    vec3 b = (high - o) * reciprocal;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    return vec2(max(max(near.x, near.y), max(near.z, 0.0)), min(far.x, min(far.y, far.z)));
}

vec2 tank_span(vec3 o, vec3 d) {
    return box_span(o, d, vec3(0.0), vec3(CELLS));
}

// A number in [0, 1) for each pixel that differs most from those of its neighbours: interleaved gradient noise (Jimenez
// 2014, "Next Generation Post Processing in Call of Duty").
float pixel_noise() {
    return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
}

#ifdef BODY
// How far along the ray o + t d, from span.x to at most span.y, it meets a body (x), and how near it came (y, in cells;
// below kTouch: met). Where it meets none, x is about where it came nearest.
const float kTouch = 0.02;

vec2 meet_body(vec3 o, vec3 d, vec2 span) {
    float t = span.x;
    vec2 nearest = vec2(t, 1e9);
    for (int i = 0; i < 48 && t < span.y && nearest.y >= kTouch; ++i) {
        float distance = solid_distance(o + t * d);
        if (distance < nearest.y) nearest = vec2(t, distance);
        t += max(distance, 0.5 * kTouch);
    }
    return nearest;
}

vec3 body_normal(vec3 x) {
    const vec2 e = vec2(0.05, 0.0);
    return normalize(vec3(solid_distance(x + e.xyy) - solid_distance(x - e.xyy),
                          solid_distance(x + e.yxy) - solid_distance(x - e.yxy),
                          solid_distance(x + e.yyx) - solid_distance(x - e.yyx)));
}
#endif
