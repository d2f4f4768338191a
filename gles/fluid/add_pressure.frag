// add_pressure.frag     phi = phi_guess + delta phi - lambda b
//
// reads   phi, increment, b   RGBA32F  Cells4 (nx, ny, nz)   [m/s]
// writes  phi                 RGBA32F  Cells4                [m/s]
// fetches 3
//
// The last term takes back what the viscous step did to the part of the velocity that the projection removed: the
// rotational form of Timmermans, Minev, van de Vosse 1996, Int. J. Numer. Meth. Fluids 22.
uniform sampler2D phi, increment, b;
uniform float scale;   // of phi: phi ~ dt p, and the step may be of another length than the last
uniform float lambda;  // nu dt / h^2

out vec4 result;

void main() {
    ivec3 c = cell_here(TARGET);
    result = scale * at(phi, TARGET, c) + at(increment, TARGET, c) - lambda * at(b, TARGET, c);
}
