// residual_products.frag     For each column of cells: sums of q.q, q.q_last, q_last.q_last, q.r,  where q = A z = r - r_z
//
// reads   r          RGBA32F  Cells4    [m/s]      residual
// reads   r_z        RGBA32F  Cells4    [m/s]      what is left of it with the correction z
// reads   q_last     RGBA32F  Cells4    [m/s]      A p of the last direction p     not by variant FIRST
// writes  products   RGBA32F, nx x ny texels
// fetches 48, FIRST 32        3 and 2 for each slab of four layers; 16 slabs are 64 layers
uniform sampler2D r, r_z;
#ifndef FIRST
uniform sampler2D q_last;
#endif

out vec4 result;

void main() {
    ivec2 column = ivec2(gl_FragCoord.xy);
    result = vec4(0.0);
    for (int slab = 0; slab < PHI.size.z; ++slab) {
        ivec3 c = ivec3(column, slab);
        vec4 left = at(r, PHI, c), q = left - at(r_z, PHI, c);
#ifdef FIRST
        result.xw += vec2(dot(q, q), dot(q, left));
#else
        vec4 last = at(q_last, PHI, c);
        result += vec4(dot(q, q), dot(q, last), dot(last, last), dot(q, left));
#endif
    }
}
