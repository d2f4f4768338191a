#pragma once
#include <glm/glm.hpp>
#include <vector>

namespace eddy {

/// The same method as gles/fluid in plain loops and doubles, one sphere in a closed box; everything in units
/// of cells, h = 1, rho = 1. What the shaders are compared with.
struct ReferenceFluid {
    glm::ivec3 n;
    glm::dvec3 centre{0.0}, velocity{0.0}, spin{0.0};  // of the sphere
    double radius = 0.0;                               // 0: no sphere
    std::vector<glm::dvec3> u;  // (nx+1)(ny+1)(nz+1), component c on the lower face of its cell
    std::vector<double> phi;    // nx ny nz

    explicit ReferenceFluid(const glm::ivec3& cells);

    std::size_t face(int i, int j, int k) const {
        return static_cast<std::size_t>((k * (n.y + 1) + j) * (n.x + 1) + i);
    }
    std::size_t cell(int i, int j, int k) const { return static_cast<std::size_t>((k * n.y + j) * n.x + i); }

    /// The fluid's share of the unit cube around x, by the closed form for a plane cut.
    double volume_share(const glm::dvec3& x) const;
    /// The same for the face of axis a around x, sharpened along a (gles/body/sharpen_fractions.frag).
    double fraction(int a, const glm::dvec3& x) const;
    glm::dvec3 solid_velocity(const glm::dvec3& x) const { return velocity + glm::cross(spin, x - centre); }
    /// Fraction of the face of axis `a` below cell (i,j,k); 0 on the walls of the box.
    double open(int a, int i, int j, int k) const;
    /// a u + (1 - a) u_solid through that face.
    double flux(int a, int i, int j, int k) const;
    double divergence(int i, int j, int k) const;

    /// u = u(x - dt u), faces moved by the velocity at their cell's centre.
    void advect(double dt);
    /// Solves for phi by conjugate gradients to `tolerance` of the right-hand side, subtracts its gradient.
    void project(double tolerance);
    /// sum phi grad(1 - a): force on the sphere, and torque about its centre.
    glm::dvec3 force() const;
    glm::dvec3 torque() const;

  private:
    double sample(int component, const glm::dvec3& s) const;
};

}  // namespace eddy
