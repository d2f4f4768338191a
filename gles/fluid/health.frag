// health.frag     For each part of a row: unsound texels of the flow, of the pressure, of scalars; the greatest speed
//
// reads   velocity     RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]     or Cells; variant FLOW
// reads   diffused     RGBA32F  Faces                      [m/s]     variant DIFFUSED
// reads   phi          RGBA32F  Cells4 (nx, ny, nz)        [m/s]     or R32F Cells; variant FLOW
// reads   smoke        R32F     Cells                      [1]       variant SMOKE
// reads   temperature  R32F     Cells                      [K]       variant TEMPERATURE
// writes  (texels of velocity, of phi, of scalars; max |u|)   RGBA32F, (parts of rows, y, z)
// fetches 8, FLOW 10, FLOW+SMOKE 18, FLOW+TEMPERATURE 18, SMOKE+TEMPERATURE 16, FLOW+SMOKE+TEMPERATURE 26, FLOW+DIFFUSED 18, FLOW+DIFFUSED+SMOKE 26, FLOW+DIFFUSED+TEMPERATURE 26, FLOW+DIFFUSED+SMOKE+TEMPERATURE 34
//
// Every texel is read once: RUN = 8 of a row of faces or cells; rows of phi are a quarter as many.
#include "guard.glsl"

#ifdef FLOW
uniform sampler2D velocity, phi;
uniform float fastest, most_phi;
#endif
#ifdef DIFFUSED
uniform sampler2D diffused;
uniform float most_diffused;
#endif
#ifdef SMOKE
uniform sampler2D smoke;
#endif
#ifdef TEMPERATURE
uniform sampler2D temperature;
#endif

out vec4 result;

struct Row {
    ivec2 first;  // texel
    int texels;
};

Row row_of(const Layout l, ivec3 c) {
    ivec3 first = ivec3(RUN * c.x, c.yz);
    if (any(greaterThanEqual(first, l.size))) return Row(ivec2(0), 0);
    return Row(texel_of(l, first), min(RUN, l.size.x - first.x));
}

float unsound_texels(sampler2D field, const Layout l, ivec3 c, float most) {
    Row row = row_of(l, c);
    float count = 0.0;
    for (int i = 0; i < row.texels; ++i) count += float(any(unsound(texelFetch(field, row.first + ivec2(i, 0), 0), most)));
    return count;
}

void main() {
    ivec3 c = cell_here(TARGET);
    result = vec4(0.0);
    if (c.z >= TARGET.size.z) return;  // the atlas may end in tiles that hold nothing
#ifdef FLOW
    Row row = row_of(VELOCITY, c);
    for (int i = 0; i < row.texels; ++i) {
        vec4 u = texelFetch(velocity, row.first + ivec2(i, 0), 0);
        if (any(unsound(u, fastest)))
            ++result.x;
        else
            result.w = max(result.w, dot(u.xyz, u.xyz));
    }
    result.w = sqrt(result.w);
    if (c.z % PHI_LAYERS == 0) result.y += unsound_texels(phi, PHI, ivec3(c.xy, c.z / PHI_LAYERS), most_phi);
#endif
#ifdef DIFFUSED
    result.x += unsound_texels(diffused, VELOCITY, c, most_diffused);
#endif
#ifdef SMOKE
    result.z += unsound_texels(smoke, SCALARS, c, kMostScalar);
#endif
#ifdef TEMPERATURE
    result.z += unsound_texels(temperature, SCALARS, c, kMostScalar);
#endif
}
