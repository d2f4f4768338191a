// diagnose.frag     For each column of cells: max |div u|, sum of |u|^2, sum of smoke, max |div u| before the projection
//
// reads   velocity    RGBA32F  Faces     [m/s]       after the projection
// reads   divergence  RGBA32F  Cells4    [m/s]       of that velocity, the solid's share included
// reads   before      RGBA32F  Cells4    [m/s]       the same before the projection
// reads   smoke       R32F     Cells     [1]         variant SMOKE
// reads   temperature R32F     Cells     [K]         variant TEMPERATURE
// writes  (max |div u|, sum u.u, sum smoke, max |div u before|)   RGBA32F, nx x ny texels
// writes  (sum of temperature, 0, 0, 0)                         the same, variant TEMPERATURE
// fetches 256
uniform sampler2D velocity, divergence, before;
#ifdef SMOKE
uniform sampler2D smoke;
#endif

layout(location = 0) out vec4 result;
#ifdef TEMPERATURE
uniform sampler2D temperature;
layout(location = 1) out vec4 heat;
#endif

float largest(vec4 v) {
    v = abs(v);
    return max(max(v.x, v.y), max(v.z, v.w));
}

void main() {
    ivec2 column = ivec2(gl_FragCoord.xy);
    result = vec4(0.0);
    for (int slab = 0; slab < PHI.size.z; ++slab) {
        result.x = max(result.x, largest(at(divergence, PHI, ivec3(column, slab))));
        result.w = max(result.w, largest(at(before, PHI, ivec3(column, slab))));
    }
#ifdef TEMPERATURE
    heat = vec4(0.0);
#endif
    for (int z = 0; z < CELLS.z; ++z) {
        ivec3 c = ivec3(column, z);
        vec3 low = at(velocity, FACES, c).xyz;
        vec3 high = vec3(at(velocity, FACES, c + ivec3(1, 0, 0)).x, at(velocity, FACES, c + ivec3(0, 1, 0)).y,
                         at(velocity, FACES, c + ivec3(0, 0, 1)).z);
        result.y += 0.5 * (dot(low, low) + dot(high, high));
#ifdef SMOKE
        result.z += at(smoke, SCALARS, c).x;
#endif
#ifdef TEMPERATURE
        heat.x += at(temperature, SCALARS, c).x;
#endif
    }
}
