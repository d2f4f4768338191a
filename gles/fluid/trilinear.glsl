// trilinear.glsl     Between the eight values around a place, of whatever kind: VALUE value(ivec3 c), in 0 .. last
//
// Sums differences, not weighted values: where all eight are the same, so is what comes out, to the last bit.
VALUE value(ivec3 c);

VALUE between(VALUE a, VALUE b, float f) {
    return a + f * (b - a);
}

// q: place among the values, value(c) at q = c; beyond the outermost ones: theirs.
VALUE trilinear(vec3 q, ivec3 last) {
    q = clamp(q, vec3(0.0), vec3(last));
    vec3 whole = floor(q), f = q - whole;
    ivec3 l = ivec3(whole), h = min(l + 1, last);
    VALUE low = between(between(value(l), value(ivec3(h.x, l.yz)), f.x),
                        between(value(ivec3(l.x, h.y, l.z)), value(ivec3(h.xy, l.z)), f.x), f.y);
    VALUE high = between(between(value(ivec3(l.xy, h.z)), value(ivec3(h.x, l.y, h.z)), f.x),
                         between(value(ivec3(l.x, h.yz)), value(h), f.x), f.y);
    return between(low, high, f.z);
}
