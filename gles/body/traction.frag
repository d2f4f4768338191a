// traction.frag     f = sum over a column of cells  phi grad(1 - a)        and its moment about the body's centre
//
// reads   phi         RGBA32F  Cells4 (nx, ny, nz)       [m/s]
// reads   ax, ay, az  RGBA32F  Faces4                    fluid fraction
// writes  force, moment   RGBA32F, one texel for each column of the body's box: rgb  [m/s cells^2], [m/s cells^3]
// fetches 35          7 for each slab of four layers; a ball of 5 cells has 5
//
// p grad(1 - a) is -p n dA in the form that does exactly the work the projection does on the fluid: with it,
// force . U is the power that the body gives, to rounding. Times rho h^3 / dt it is newtons (rho h^4 / dt: newton metres).
uniform sampler2D phi, ax, ay, az;
uniform ivec3 box_low, box_high;  // in cells; z in slabs of four
uniform vec3 pivot;               // the body's centre  [cells]
uniform int body;

layout(location = 0) out vec4 force;
layout(location = 1) out vec4 moment;

void main() {
    force = vec4(0.0);
    moment = vec4(0.0);
    ivec2 column = ivec2(gl_FragCoord.xy) + box_low.xy;
    if (any(greaterThanEqual(column, box_high.xy))) return;
    for (int slab = box_low.z; slab < box_high.z; ++slab) {
        ivec3 c = ivec3(column, slab);
        vec4 p = at(phi, PHI, c);
        vec4 lz = at(az, FRACTION, c);
        vec4 gx = at(ax, FRACTION, c) - at(ax, FRACTION, c + ivec3(1, 0, 0));
        vec4 gy = at(ay, FRACTION, c) - at(ay, FRACTION, c + ivec3(0, 1, 0));
        vec4 gz = lz - vec4(lz.yzw, at_clamped(az, FRACTION, c + ivec3(0, 0, 1)).x);
        for (int lane = 0; lane < 4; ++lane) {
            if (4 * slab + lane >= CELLS.z) break;
            vec3 x = vec3(column, 4 * slab + lane) + 0.5;
            if (nearest_body(x) != body) continue;
            vec3 f = p[lane] * vec3(gx[lane], gy[lane], gz[lane]);
            force.xyz += f;
            moment.xyz += cross(x - pivot, f);
        }
    }
}
