// owners.frag     number of the body nearest to each lower face of a cell, and to its centre
//
// reads   the bodies' shapes and poses (uniforms)                      [cells]
// writes  owners      RGBA32F  Faces (nx+1, ny+1, nz+1)                r,g,b of the x-, y-, z-face, a of the centre
// fetches 0
out vec4 result;

void main() {
    vec3 x = vec3(cell_here(TARGET));
    result = vec4(nearest_body(x + vec3(0.0, 0.5, 0.5)), nearest_body(x + vec3(0.5, 0.0, 0.5)),
                  nearest_body(x + vec3(0.5, 0.5, 0.0)), nearest_body(x + 0.5));
}
