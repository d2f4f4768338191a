// pass.vert     Covers the target, or one box of it in every slab, without vertex data.
//
// Everything: one triangle, rect twice the target. A box: a strip of two triangles for each slab (one instance each).
uniform ivec4 rect;      // low and high corner in texels of a slab
uniform int first_slab;

void main() {
    ivec2 corner = ivec2(gl_VertexID & 1, gl_VertexID >> 1);
    int slab = first_slab + gl_InstanceID;
    ivec2 origin = ivec2(slab % TARGET.tiles_x, slab / TARGET.tiles_x) * TARGET.size.xy;
    vec2 texel = vec2(origin + rect.xy + corner * (rect.zw - rect.xy));
    gl_Position = vec4(texel * TARGET.texel * 2.0 - 1.0, 0.0, 1.0);
}
