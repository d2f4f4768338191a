#include "firmware/accuracy/shell_flow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace eddy::accuracy {
namespace {

constexpr double kOmega = 4.0 * std::numbers::pi;  // 2 Hz

/// A ball of 1 cm in glycerine.
BallInShell glycerine(double shell_m) {
    return {0.01, shell_m, 1260.0, 1.412};
}

TEST(BallInShell, IsStokesOscillatingBallWhereTheShellIsFar) {
    // Stokes 1851: F = -6 pi mu a (1 + a / d) U - (2/3) pi rho a^3 (1 + 9 d / 2 a) dU/dt, d = sqrt(2 nu / w).
    const std::complex<double> z = glycerine(10.0).impedance({0.0, kOmega});
    EXPECT_NEAR(z.real(), 0.46545, 1e-5);
    EXPECT_NEAR(z.imag() / kOmega, 0.018498, 1e-6);
}

TEST(BallInShell, IsTheSteadyDragInAShellWhereItIsSlow) {
    // (1 - l^5) / (1 - 9 l / 4 + 5 l^3 / 2 - 9 l^5 / 4 + l^6) times 6 pi mu a, l = 0.25 (Haberman and Sayre 1958).
    const double drag = 6.0 * std::numbers::pi * 1.412 * 0.01 * 2.10494;
    EXPECT_NEAR(glycerine(0.04).impedance(1e-3).real() / drag, 1.0, 1e-4);
    EXPECT_NEAR(glycerine(0.04).resistance_after(10.0) / drag, 1.0, 1e-4);
}

TEST(BallInShell, MovesItsAddedMassWhereItIsQuick) {
    const BallInShell ball{0.01, 0.025, 1000.0, 1e-9};
    EXPECT_NEAR(ball.impedance({0.0, kOmega}).imag() / kOmega / ball.added_mass_kg(), 1.0, 1e-3);
    EXPECT_NEAR(ball.added_mass_kg() / (1000.0 * 4.0 / 3.0 * std::numbers::pi * 1e-6), 0.60256, 1e-5);
}

TEST(BallInShell, ThatIsSetGoingFeelsStokesDragAndMore) {
    // Without walls 1 + a / sqrt(pi nu t) times Stokes' drag (Basset 1888).
    const double stokes = 6.0 * std::numbers::pi * 1.412 * 0.01, nu = 1.412 / 1260.0;
    for (const auto& [time, ratio] :
         {std::pair(0.04, 3.8209), std::pair(0.25, 2.1284), std::pair(1.0, 1.5642)})
        EXPECT_NEAR(glycerine(10.0).resistance_after(time * 1e-4 / nu) / stokes, ratio, 1e-3) << time;
}

}  // namespace
}  // namespace eddy::accuracy
