// open.glsl     The fluid's shares, where they are read beyond the boxes that are drawn anew in this step
#include "guard.glsl"

// Open where it cannot be a share; a sharpened one is a little larger than 1 at most.
vec4 share(vec4 a) {
    return mix(a, vec4(1.0), unsound(a, 2.0));  // guard shares
}
