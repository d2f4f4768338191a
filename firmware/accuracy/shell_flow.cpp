#include "firmware/accuracy/shell_flow.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace eddy::accuracy {
namespace {

using Complex = std::complex<double>;
using Row = std::array<Complex, 5>;  // four factors and the right-hand side

constexpr double kPi = std::numbers::pi;

/// Solves four equations for four unknowns.
std::array<Complex, 4> solved(std::array<Row, 4> rows) {
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j)
            if (std::abs(rows[j][i]) > std::abs(rows[i][i])) std::swap(rows[i], rows[j]);
        for (std::size_t j = 0; j < 4; ++j) {
            if (j == i) continue;
            const Complex factor = rows[j][i] / rows[i][i];
            for (std::size_t k = i; k < 5; ++k) rows[j][k] -= factor * rows[i][k];
        }
    }
    std::array<Complex, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = rows[i][4] / rows[i][i];
    return x;
}

/// Vortical part of F below, of a wave that fades towards +r (sign 1) or -r (sign -1) from r = start: F, F', F''.
std::array<Complex, 3> wave(double sign, const Complex& alpha, double r, double start) {
    const Complex k = sign * alpha, e = std::exp(-k * (r - start));
    return {e * (1.0 + 1.0 / (k * r)), -e * (k + 1.0 / r + 1.0 / (k * r * r)),
            e * (k * k + k / r + 2.0 / (r * r) + 2.0 / (k * r * r * r))};
}

}  // namespace

std::complex<double> BallInShell::impedance(std::complex<double> s) const {
    // u_r = 2 cos(theta) F / r^2,  u_theta = -sin(theta) F' / r,  F = A r^2 + B / r + C wave(+) + D wave(-);
    // F = a^2 / 2, F' = a on the ball, both 0 on the shell. The pressure is that of A and B: p = -rho s phi, u = grad phi.
    const double a = radius_m, b = shell_m;
    const Complex alpha = std::sqrt(s * density_kg_m3 / viscosity_pa_s);
    const auto out = wave(1.0, alpha, a, a), out_far = wave(1.0, alpha, b, a);
    const auto in = wave(-1.0, alpha, a, b), in_far = wave(-1.0, alpha, b, b);
    const auto [A, B, C, D] = solved({{{a * a, 1.0 / a, out[0], in[0], 0.5 * a * a},
                                       {2.0 * a, -1.0 / (a * a), out[1], in[1], a},
                                       {b * b, 1.0 / b, out_far[0], in_far[0], 0.0},
                                       {2.0 * b, -1.0 / (b * b), out_far[1], in_far[1], 0.0}}});
    const Complex bend = 2.0 * A + 2.0 * B / (a * a * a) + C * out[2] + D * in[2];
    const Complex friction = 8.0 / 3.0 * kPi * viscosity_pa_s * a * (bend - 1.0);
    const Complex pressure = 4.0 / 3.0 * kPi * a * a * density_kg_m3 * s * (2.0 * A * a - B / (a * a));
    return -(friction + pressure);
}

double BallInShell::added_mass_kg() const {
    const double l3 = std::pow(radius_m / shell_m, 3);
    return 0.5 * (1.0 + 2.0 * l3) / (1.0 - l3) * density_kg_m3 * 4.0 / 3.0 * kPi * std::pow(radius_m, 3);
}

double BallInShell::resistance_after(double t_s) const {
    // The inverse Laplace transform of Z / s, less the blow, along Talbot's contour (Abate and Valko 2004).
    constexpr int kPoints = 16;
    const double blow = added_mass_kg();
    double sum = 0.0;
    for (int k = 0; k < kPoints; ++k) {
        const double angle = k * kPi / kPoints, cot = k > 0 ? 1.0 / std::tan(angle) : 0.0;
        const Complex delta = k > 0 ? 0.4 * kPi * k * Complex(cot, 1.0) : Complex(0.4 * kPoints);
        const Complex weight =
            k > 0 ? Complex(1.0, angle * (1.0 + cot * cot) - cot) * std::exp(delta) : 0.5 * std::exp(delta);
        const Complex s = delta / t_s;
        sum += (weight * (impedance(s) / s - blow)).real();
    }
    return 0.4 / t_s * sum;
}

}  // namespace eddy::accuracy
