// diagnose.frag     For each column of cells: max |d|, sum of |u|^2, sum of smoke, max |d before|
//
// reads   velocity    RGBA32F  Cells (nx, ny, nz)   [m/s]   after the projection
// reads   divergence  R32F     Cells                [m/s]   of that velocity
// reads   before      R32F     Cells                [m/s]   the same before the projection
// reads   obstacles   RGBA32F  Cells, T_IO                  variant OBSTACLES: |d| counts in fluid only
// reads   smoke       R32F     Cells                [1]     variant SMOKE
// writes  (max |d|, sum u.u, sum smoke, max |d before|)   RGBA32F, nx x ny texels
// fetches 320
//
// 5 for each layer; 320 is for 64 layers.
uniform sampler2D velocity, divergence, before;
#ifdef OBSTACLES
#include "cell_types.glsl"
uniform sampler2D obstacles;
#endif
#ifdef SMOKE
uniform sampler2D smoke;
#endif

out vec4 result;

void main() {
    ivec2 column = ivec2(gl_FragCoord.xy);
    result = vec4(0.0);
    for (int z = 0; z < CELLS.size.z; ++z) {
        ivec3 c = ivec3(column, z);
        vec3 u = at(velocity, CELLS, c).xyz;
        result.y += dot(u, u);
#ifdef SMOKE
        result.z += at(smoke, CELLS, c).x;
#endif
#ifdef OBSTACLES
        if (is_obstacle(at(obstacles, CELLS, c))) continue;
#endif
        result.x = max(result.x, abs(at(divergence, CELLS, c).x));
        result.w = max(result.w, abs(at(before, CELLS, c).x));
    }
}
