#include "hal/haptic/falcon/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hal/haptic/falcon/rig.h"

namespace eddy {
namespace {

using falcon::Calibration;
using ::testing::HasSubstr;
using Stage = Calibration::Stage;

constexpr double kHandle = 0.10;  // [kg] that the motors carry before anything hangs on the handle

/// Told 10 000, and to believe what is between these.
Calibration with_100_g(double least = 1e3, double most = 1e5) {
    return {0.1, falcon::kMotorUnitsPerNm, least, most};
}

/// A Falcon whose motors are worth `units_per_nm`, told 10 000; nobody holds it, and the person who calibrates it hangs
/// `hung_kg` on when asked.
struct Bench {
    explicit Bench(double units_per_nm, double friction_n = 0.0)
        : rig({.motor_units_per_nm = units_per_nm}, {}, still({0.01, -0.02, 0.01}),
              {.hand = emulated::Hand::None, .handle_friction_n = friction_n}) {
        rig.board().plant().hang(kHandle);
    }

    Stage calibrate(Calibration& calibration, double hung_kg) {
        while (rig.now < std::chrono::minutes(3)) {
            rig.now += std::chrono::milliseconds(1);
            rig.driver->poll(rig.now);
            const auto reading = rig.driver->read();
            rig.driver->command(calibration.tick(rig.now, reading));
            if (calibration.stage() == Stage::HangOn) {
                // Lowered within three seconds, as one does.
                const double share = ++waited_ms / 3000.0;
                rig.board().plant().hang(kHandle + share * hung_kg);
                if (share >= 1.0) calibration.weight_hangs();
            }
            if (calibration.stage() == Stage::Done || calibration.stage() == Stage::Failed) break;
        }
        return calibration.stage();
    }
    Rig rig;
    int waited_ms = 0;
};

TEST(FalconCalibration, FindsTheTrueForceScale) {
    for (const double truth : {4000.0, 10000.0, 25000.0}) {
        Bench bench(truth);
        Calibration calibration = with_100_g();
        ASSERT_EQ(bench.calibrate(calibration, 0.1), Stage::Done) << truth << ": " << calibration.problem();
        EXPECT_NEAR(calibration.motor_units_per_nm() / truth, 1.0, 0.01);
        EXPECT_LT(calibration.spread(), 0.01);
        EXPECT_EQ(bench.rig.driver->counters().saturated, 0U);
    }
}

TEST(FalconCalibration, LetsGoWhereNobodyHangsTheWeightOn) {
    Bench bench(10000.0);
    Calibration calibration = with_100_g();
    while (bench.rig.now < std::chrono::minutes(5) && calibration.stage() != Stage::Failed) {
        bench.rig.now += std::chrono::milliseconds(1);
        bench.rig.driver->poll(bench.rig.now);
        bench.rig.driver->command(calibration.tick(bench.rig.now, bench.rig.driver->read()));
    }
    EXPECT_THAT(calibration.problem(), HasSubstr("three minutes"));
    EXPECT_EQ(calibration.tick(bench.rig.now, bench.rig.driver->read()), glm::dvec3(0.0));
}

TEST(FalconCalibration, IsNotMisledByFriction) {
    Bench bench(12000.0, 0.2);
    Calibration calibration = with_100_g();
    ASSERT_EQ(bench.calibrate(calibration, 0.1), Stage::Done) << calibration.problem();
    EXPECT_NEAR(calibration.motor_units_per_nm() / 12000.0, 1.0, 0.02) << "a fifth of the weight is friction";
}

TEST(FalconCalibration, NoticesThatTheWeightWasNotHungOn) {
    Bench bench(10000.0);
    Calibration calibration = with_100_g();
    EXPECT_EQ(bench.calibrate(calibration, 0.0), Stage::Failed);
    EXPECT_THAT(calibration.problem(), HasSubstr("did not feel the weight"));
}

TEST(FalconCalibration, BelievesNoScaleThatMayNotBeSet) {
    Bench bench(12000.0);
    Calibration calibration = with_100_g(1e3, 11000.0);
    EXPECT_EQ(bench.calibrate(calibration, 0.1), Stage::Failed);
}

TEST(FalconCalibration, LetsGoOfAHandleThatRunsAway) {
    Bench bench(10000.0);
    Calibration calibration = with_100_g();
    EXPECT_EQ(bench.calibrate(calibration, 3.0), Stage::Failed) << "far too heavy";
    EXPECT_THAT(calibration.problem(), HasSubstr("ran away"));
    bench.rig.run(5);
    EXPECT_EQ(bench.rig.board().last_command().motors, falcon::Axes{});
}

TEST(FalconCalibration, LetsGoWhenMotorsPushTheWrongWay) {
    Bench bench(-10000.0);
    Calibration calibration = with_100_g();
    EXPECT_EQ(bench.calibrate(calibration, 0.1), Stage::Failed);
    EXPECT_THAT(calibration.problem(), HasSubstr("ran away"));
}

TEST(FalconCalibration, LetsGoOfADeviceThatStopsAnswering) {
    Bench bench(10000.0);
    Calibration calibration = with_100_g();
    ASSERT_GE(bench.rig.until(HapticState::Ready, 1000), 0);
    for (int ms = 0; ms < 2000; ++ms) {
        if (ms == 1000) bench.rig.device().line_dead = true;
        bench.rig.now += std::chrono::milliseconds(1);
        bench.rig.driver->poll(bench.rig.now);
        bench.rig.driver->command(calibration.tick(bench.rig.now, bench.rig.driver->read()));
        EXPECT_TRUE(ms < 1030 || calibration.stage() == Stage::Failed) << ms;
    }
    EXPECT_THAT(calibration.problem(), HasSubstr("stopped answering"));
}

}  // namespace
}  // namespace eddy
