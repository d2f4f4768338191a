// health.frag     For each part of a column: unsound texels of the flow, of the pressure, of scalars; the greatest speed
//
// reads   velocity     RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]     or Cells; variant FLOW
// reads   diffused     RGBA32F  Faces                      [m/s]     variant DIFFUSED
// reads   phi          RGBA32F  Cells4 (nx, ny, nz)        [m/s]     or R32F Cells; variant FLOW
// reads   smoke        R32F     Cells                      [1]       variant SMOKE
// reads   temperature  R32F     Cells                      [K]       variant TEMPERATURE
// writes  (texels of velocity, of phi, of scalars; max |u|)   RGBA32F, (columns x, y, PARTS)
// fetches 0, FLOW 10, SMOKE 8, TEMPERATURE 8, FLOW+SMOKE 18, FLOW+TEMPERATURE 18, SMOKE+TEMPERATURE 16, FLOW+SMOKE+TEMPERATURE 26, FLOW+DIFFUSED 18, FLOW+DIFFUSED+SMOKE 26, FLOW+DIFFUSED+TEMPERATURE 26, FLOW+DIFFUSED+SMOKE+TEMPERATURE 34
//
// Every texel is read once: 8 layers of faces or cells, and 2 of four cells each.
#include "guard.glsl"

#ifdef FLOW
uniform sampler2D velocity, phi;
uniform float fastest, most_phi;
#endif
#ifdef DIFFUSED
uniform sampler2D diffused;
#endif
#ifdef SMOKE
uniform sampler2D smoke;
#endif
#ifdef TEMPERATURE
uniform sampler2D temperature;
#endif

out vec4 result;

// First slab of part `part` of a layout.
int first_slab(const Layout l, int part) {
    return part * l.size.z / PARTS;
}

float unsound_texels(sampler2D field, const Layout l, ivec3 c, float most) {
    float count = 0.0;
    if (all(lessThan(c.xy, l.size.xy)))
        for (int z = first_slab(l, c.z); z < first_slab(l, c.z + 1); ++z)
            count += float(any(unsound(at(field, l, ivec3(c.xy, z)), most)));
    return count;
}

void main() {
    ivec3 c = cell_here(TARGET);
    result = vec4(0.0);
    if (c.z >= PARTS) return;  // the atlas may end in tiles that hold nothing
#ifdef FLOW
    for (int z = first_slab(VELOCITY, c.z); z < first_slab(VELOCITY, c.z + 1); ++z) {
        vec4 u = at(velocity, VELOCITY, ivec3(c.xy, z));
        if (any(unsound(u, fastest)))
            ++result.x;
        else
            result.w = max(result.w, length(u.xyz));
    }
    result.y += unsound_texels(phi, PHI, c, most_phi);
#endif
#ifdef DIFFUSED
    result.x += unsound_texels(diffused, VELOCITY, c, fastest);
#endif
#ifdef SMOKE
    result.z += unsound_texels(smoke, SCALARS, c, kMostScalar);
#endif
#ifdef TEMPERATURE
    result.z += unsound_texels(temperature, SCALARS, c, kMostScalar);
#endif
}
