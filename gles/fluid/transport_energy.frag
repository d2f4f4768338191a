// transport_energy.frag     For each part of a row: sum of |u|^2 before and after transport
//
// reads   before, after   RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// writes  (sum before, sum after, 0, 0)   RGBA32F, (parts of rows, ny+1, nz+1)
// fetches 16
//
// A component counts where its face lies in the tank. Those on the walls do not: the projection puts them right.
uniform sampler2D before, after;

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    result = vec4(0.0);
    if (c.z >= TARGET.size.z) return;  // the atlas may end in tiles that hold nothing
    for (int i = 0; i < RUN; ++i) {
        ivec3 face = ivec3(RUN * c.x + i, c.yz);
        if (face.x > CELLS.x) break;
        bvec3 within = greaterThan(face, ivec3(0)), last = equal(face, CELLS);
        vec3 counts = vec3(within.x && !any(last), within.y && !any(last), within.z && !any(last));
        vec3 u = counts * at(before, FACES, face).xyz, v = counts * at(after, FACES, face).xyz;
        result.xy += vec2(dot(u, u), dot(v, v));
    }
}
