// distances.frag     d = signed distance of each face to the nearest body's surface, negative inside
//
// reads   the bodies' shapes and poses (uniforms)                      [cells]
// writes  d           RGBA32F  Faces (nx+1, ny+1, nz+1) of a grid SCALE times as coarse     [cells of that grid]
// fetches 0
out vec4 result;

void main() {
    vec3 x = vec3(cell_here(TARGET));
    result = vec4(solid_distance(SCALE * (x + vec3(0.0, 0.5, 0.5))), solid_distance(SCALE * (x + vec3(0.5, 0.0, 0.5))),
                  solid_distance(SCALE * (x + vec3(0.5, 0.5, 0.0))), 0.0) / SCALE;
}
