// maccormack.glsl     phi = phi^ + (phi - phi~) / 2, kept within the values that phi^ was interpolated from
//
// Selle, Fedkiw, Kim, Liu, Rossignac 2008, "An unconditionally stable MacCormack method": phi^ is traced forward, phi~
// traced back from phi^; half their error is taken out. The limiter makes it stable and free of new extremes.

// Least and greatest of the eight values around s (cells, centres at +1/2), all channels.
void donors(sampler2D field, const Layout l, vec3 s, out vec4 least, out vec4 most) {
    ivec3 c = ivec3(floor(clamp(s, vec3(0.5), vec3(l.size) - 0.5) - 0.5));
    least = at(field, l, c);
    most = least;
    for (int i = 1; i < 8; ++i) {
        vec4 v = at_clamped(field, l, c + ivec3(i & 1, (i >> 1) & 1, i >> 2));
        least = min(least, v);
        most = max(most, v);
    }
}
