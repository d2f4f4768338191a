// drive.frag     u = u_source inside a source's ball, elsewhere untouched
//
// reads   nothing
// writes  u       RGBA32F  Faces (nx+1, ny+1, nz+1)   [m/s]
// fetches 0
uniform vec4 ball;           // centre, radius  [cells]
uniform vec3 ball_velocity;  // [m/s]

out vec4 result;

void main() {
    // The three faces of this cell lie half a cell apart; the cell's centre decides for them together.
    if (distance(vec3(cell_here(TARGET)) + 0.5, ball.xyz) > ball.w) discard;
    result = vec4(ball_velocity, 0.0);
}
