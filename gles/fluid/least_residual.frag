// least_residual.frag     p = z - beta p_last,  phi += alpha p,  r -= alpha A p,  with the alpha that leaves the least r.r
//
// reads   products         RGBA32F  1 texel           as residual_products.frag has them
// reads   phi, z, r, r_z   RGBA32F  Cells4   [m/s]    A z = r - r_z
// reads   p_last, q_last   RGBA32F  Cells4   [m/s]    the last direction and A of it     not by variant FIRST
// writes  phi, r, p, q     RGBA32F  Cells4   [m/s]    q = A p
// fetches 7, FIRST 5
//
// beta makes A p orthogonal to the last one, and r is orthogonal to that already: so alpha = q.r / q.q is the best of both.
uniform sampler2D products, phi, z, r, r_z;
#ifndef FIRST
uniform sampler2D p_last, q_last;
#endif

layout(location = 0) out vec4 new_phi;
layout(location = 1) out vec4 new_r;
layout(location = 2) out vec4 p;
layout(location = 3) out vec4 q;

const float kNothing = 1e-37;

void main() {
    ivec3 c = cell_here(TARGET);
    vec4 left = at(r, TARGET, c), sums = texelFetch(products, ivec2(0), 0);
    new_phi = at(phi, TARGET, c);
    new_r = left;
#ifdef FIRST
    const float beta = 0.0;
    p = q = vec4(0.0);
#else
    float beta = sums.y / max(sums.z, kNothing);
    p = at(p_last, TARGET, c);
    q = at(q_last, TARGET, c);
#endif
    float square = sums.x - beta * sums.y;
    // Else nothing is corrected, and the last direction stays: a correction along it says nothing new, and what rounding leaves
    // is no direction. Nor is it so for sums that are not numbers: one such value in r would get to every cell of phi.
    if (square > max(1e-4 * sums.x, kNothing)) {
        p = at(z, TARGET, c) - beta * p;
        q = left - at(r_z, TARGET, c) - beta * q;
        float alpha = sums.w / square;
        new_phi += alpha * p;
        new_r -= alpha * q;
    }
}
