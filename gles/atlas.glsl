// atlas.glsl     How 3D grids lie in 2D textures; the only shader file that knows. The same in gles/atlas.h.
//
// A Layout is `size.z` slabs of size.x * size.y texels, in rows of `tiles_x`. It is a compile-time constant: dividing by
// a constant is what makes full-screen passes cheap on a software rasteriser.
struct Layout {
    ivec3 size;
    int tiles_x;
    vec2 texel;  // 1 / texture size
};

ivec2 texel_of(const Layout l, ivec3 c) {
    return ivec2((c.z % l.tiles_x) * l.size.x + c.x, (c.z / l.tiles_x) * l.size.y + c.y);
}

#ifndef VERTEX_SHADER
// The cell of layout l that this fragment writes.
ivec3 cell_here(const Layout l) {
    ivec2 t = ivec2(gl_FragCoord.xy);
    ivec2 tile = ivec2(t.x / l.size.x, t.y / l.size.y);
    return ivec3(t - tile * l.size.xy, tile.y * l.tiles_x + tile.x);
}
#endif

// The value stored at cell c, which must lie inside the layout.
vec4 at(sampler2D field, const Layout l, ivec3 c) {
    return texelFetch(field, texel_of(l, c), 0);
}

// The value at the nearest cell inside the layout: zero gradient across the border.
vec4 at_clamped(sampler2D field, const Layout l, ivec3 c) {
    return at(field, l, clamp(c, ivec3(0), l.size - 1));
}

// Of four cells that lie over each other, that in layer z.
float lane(vec4 four, int z) {
    return dot(four, vec4(equal(ivec4(z & 3), ivec4(0, 1, 2, 3))));
}

// Linear in x and y within slab z. s: position in texels of the slab, texel centres at +1/2, inside [1/2, size - 1/2].
vec4 sample_slab(sampler2D field, const Layout l, vec2 s, int z) {
    vec2 origin = vec2((z % l.tiles_x) * l.size.x, (z / l.tiles_x) * l.size.y);
#ifdef FILTERS_FLOAT
    return texture(field, (origin + s) * l.texel);
#else
    vec2 low = floor(s - 0.5);
    vec2 f = s - 0.5 - low;
    ivec2 t00 = ivec2(origin + low);
    ivec2 t11 = ivec2(origin + min(low + 1.0, vec2(l.size.xy) - 1.0));
    return mix(mix(texelFetch(field, t00, 0), texelFetch(field, ivec2(t11.x, t00.y), 0), f.x),
               mix(texelFetch(field, ivec2(t00.x, t11.y), 0), texelFetch(field, t11, 0), f.x), f.y);
#endif
}

// Trilinear, one texel a cell. s: position in cells, centres at +1/2; clamped to the outermost centres.
vec4 sample_linear(sampler2D field, const Layout l, vec3 s) {
    s = clamp(s, vec3(0.5), vec3(l.size) - 0.5);
    float z = floor(s.z - 0.5);
    int z0 = int(z);
    return mix(sample_slab(field, l, s.xy, z0), sample_slab(field, l, s.xy, min(z0 + 1, l.size.z - 1)), s.z - 0.5 - z);
}
