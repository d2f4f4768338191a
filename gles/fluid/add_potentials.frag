// add_potentials.frag     phi = phi + v.x phi_x + v.y phi_y + v.z phi_z
//
// reads   phi                    RGBA32F  Cells4 (nx, ny, nz)   [m/s]
// reads   phi_x, phi_y, phi_z    RGBA32F  Cells4                [1]    potentials of a body's unit velocities
// writes  phi                    RGBA32F  Cells4                [m/s]
// fetches 4
uniform sampler2D phi, phi_x, phi_y, phi_z;
uniform vec3 v;  // by which the body's velocities differ from what phi was solved for  [m/s]

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    result = at(phi, TARGET, c) + v.x * at(phi_x, TARGET, c) + v.y * at(phi_y, TARGET, c) + v.z * at(phi_z, TARGET, c);
}
