#pragma once
#include <complex>

namespace eddy::accuracy {

/// A ball in the middle of a round shell at rest, and the viscous fluid between them.
struct BallInShell {
    double radius_m, shell_m;
    double density_kg_m3, viscosity_pa_s;  ///< of the fluid

    /// Z(s) in F = -Z U, for a ball whose velocity is U exp(s t), so small that only friction, pressure and inertia count
    /// (Stokes 1851): at s = i w its real part is the damping b [kg/s], its imaginary part w times the added inertia m.
    std::complex<double> impedance(std::complex<double> s) const;
    /// m of oscillations so quick that friction stays at the surfaces [kg] (Lamb, Hydrodynamics).
    double added_mass_kg() const;
    /// -F on a ball that moves at 1 m/s from t = 0 on [N], after the blow that sets it going.
    double resistance_after(double t_s) const;
};

}  // namespace eddy::accuracy
