#include "hal/haptic/emulated/person_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace eddy::emulated {
namespace {

glm::dvec3 acceleration(const HandMotion& motion, double t) {
    constexpr double kH = 1e-3;
    return (motion.position_m(Seconds(t + kH)) - 2.0 * motion.position_m(Seconds(t)) +
            motion.position_m(Seconds(t - kH))) /
           (kH * kH);
}

TEST(PersonMotion, StaysInItsBox) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 99U, 12345U}) {
        const PersonSettings settings{
            .seed = seed, .centre_m = {0.01, -0.005, 0.002}, .half_size_m = {0.03, 0.02, 0.015}};
        const PersonMotion motion(settings);
        glm::dvec3 farthest(0.0);
        for (double t = -5.0; t < 130.0; t += 0.002) {
            const glm::dvec3 off = glm::abs(motion.position_m(Seconds(t)) - settings.centre_m);
            farthest = glm::max(farthest, off);
        }
        const double rounding = 1e-12;
        EXPECT_LE(farthest.x, settings.half_size_m.x + rounding);
        EXPECT_LE(farthest.y, settings.half_size_m.y + rounding);
        EXPECT_LE(farthest.z, settings.half_size_m.z + rounding);
        EXPECT_GT(farthest.x, 0.8 * settings.half_size_m.x) << "it uses the box";
    }
}

TEST(PersonMotion, MovesAsGentlyAsAPerson) {
    for (const std::uint64_t seed : {1U, 7U}) {
        const PersonMotion motion({.seed = seed});
        double largest = 0.0;
        double fastest = 0.0;
        for (double t = 0.0; t < 250.0; t += 0.001) {
            largest = std::max(largest, glm::length(acceleration(motion, t)));
            fastest = std::max(
                fastest,
                glm::length(motion.position_m(Seconds(t + 1e-3)) - motion.position_m(Seconds(t))) / 1e-3);
        }
        // Recorded hands peak at 14 m/s2 and 0.6 m/s (BROAD trials 07 and 18).
        EXPECT_LT(largest, 5.0) << "[m/s2]";
        EXPECT_LT(fastest, 0.45) << "[m/s]";
        EXPECT_GT(fastest, 0.1);
    }
}

TEST(PersonMotion, HasNoJumpOfAcceleration) {
    const PersonMotion motion({.seed = 4});
    double largest = 0.0;
    for (double t = 0.0; t < 250.0; t += 0.001)
        largest = std::max(largest, glm::length(acceleration(motion, t + 0.001) - acceleration(motion, t)));
    // A jump would be of the order of the acceleration itself, some m/s2; smooth motion changes by its jerk
    // times 1 ms.
    EXPECT_LT(largest, 0.2) << "[m/s2] in a millisecond";
}

TEST(PersonMotion, IsTheSameForTheSameSeedEverywhere) {
    const PersonMotion a({.seed = 5});
    const PersonMotion b({.seed = 5});
    const PersonMotion c({.seed = 6});
    for (double t = 0.0; t < 120.0; t += 0.1) ASSERT_EQ(a.position_m(Seconds(t)), b.position_m(Seconds(t)));
    EXPECT_GT(glm::length(a.position_m(Seconds(30.0)) - c.position_m(Seconds(30.0))), 1e-4);
    // Written down on x86-64, g++ 12.
    EXPECT_LT(glm::length(a.position_m(Seconds(30.0)) -
                          glm::dvec3(0.025025466067, -0.004089568478, -0.006883474693)),
              1e-9);
}

}  // namespace
}  // namespace eddy::emulated
