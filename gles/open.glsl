// open.glsl     The fluid's shares, where they are read beyond the boxes that are drawn anew in this step
#include "guard.glsl"

// Open where it cannot be a share; a sharpened one is a little larger than 1 at most.
vec4 share(vec4 a) {
    return mix(a, vec4(1.0), unsound(a, 2.0));  // guard shares
}

// Of the cell in layer z, which this slab of four holds.
float share_in(sampler2D a, const Layout l, ivec3 slab, int z) {
    return lane(share(at(a, l, slab)), z);  // guard shares
}

// Of the upper z faces of a slab's four cells, whose lower ones have `low`. The last belongs to the next slab, which may lie beyond.
vec4 upper_z(sampler2D az, const Layout l, ivec3 c, vec4 low) {
    return vec4(low.yzw, share(at_clamped(az, l, c + ivec3(0, 0, 1))).x);  // guard shares
}
