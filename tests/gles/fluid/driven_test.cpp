#include "gles/fluid/driven.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace eddy::gles {
namespace {

FluidSetup metre_of_fluid() {
    FluidSetup s;
    s.cells = glm::ivec3(10);
    s.cell_m = 0.1;
    return s;
}

WallSetup blowing(std::function<double(double)> speed) {
    return {.kind = WallKind::Inflow,
            .velocity_at = [speed](const glm::dvec3&, double t) { return glm::dvec3(speed(t), 0.0, 0.0); }};
}

TEST(Driven, IsAsFastAsItsFastestBodyWhichMayTurn) {
    FluidSetup s = metre_of_fluid();
    s.bodies = {BodySetup{Sphere{0.2}}};
    Driven driven(s);
    driven.go_on({BodyState{.velocity_m_s = {0.0, 3.0, 0.0}, .spin_rad_s = {5.0, 0.0, 0.0}}}, 0.0, 0.01);
    EXPECT_DOUBLE_EQ(driven.lately_m_s(), 3.0 + 5.0 * 0.2);
}

TEST(Driven, IsAsFastAsAWallBlows) {
    FluidSetup s = metre_of_fluid();
    s.walls[1] = blowing([](double t) { return -2.0 * t; });
    Driven driven(s);
    driven.go_on({}, 0.5, 0.1);
    EXPECT_DOUBLE_EQ(driven.lately_m_s(), 1.2);
}

TEST(Driven, ForgetsInAFewCrossingsOfTheTank) {
    const FluidSetup s = metre_of_fluid();
    Driven driven(s);
    driven.start(2.0);
    for (int i = 0; i < 200; ++i) driven.go_on({}, 0.01 * i, 0.01);  // four crossings at 2 m/s
    EXPECT_NEAR(driven.lately_m_s(), 1.0, 0.01);
    EXPECT_DOUBLE_EQ(driven.through_gaps_m_s(0.01), 3.0 * 2.0) << "the flow that it drove may last";
}

TEST(Driven, KnowsNoSpeedOfWhatFalls) {
    FluidSetup s = metre_of_fluid();
    s.gravity_m_s2 = {0.0, -9.81, 0.0};
    s.smoke = SmokeSetup{.weight = 0.1};
    Driven driven(s);
    driven.start(1.0);
    EXPECT_GE(driven.lately_m_s(), 1e30);
    EXPECT_DOUBLE_EQ(driven.through_gaps_m_s(0.01), 5.0 * 0.1 / 0.01) << "five cells in a step";
    EXPECT_DOUBLE_EQ(driven.through_gaps_m_s(1.0), 3.0 * 1.0 + 9.81) << "or what is known";
}

TEST(Driven, IsSuddenWhereAnInflowBeginsOrEndsAndNotWhereItSwells) {
    FluidSetup s = metre_of_fluid();
    s.walls[0] = blowing([](double t) { return t < 1.0 ? 1.0 : 0.0; });
    Driven driven(s);
    const auto sudden = [&](double time_s) {
        driven.go_on({}, time_s, 0.02);
        return driven.is_sudden();
    };
    EXPECT_TRUE(sudden(0.5)) << "from nothing";
    EXPECT_FALSE(sudden(0.6));
    EXPECT_TRUE(sudden(0.99));
    EXPECT_FALSE(sudden(1.1));

    s.walls[0] = blowing([](double t) { return std::sin(6.283 * t); });
    Driven swelling(s);
    bool any = false;
    for (int i = 0; i < 200; ++i) {
        swelling.go_on({}, 0.02 * i, 0.02);
        any = any || (i > 5 && swelling.is_sudden());
    }
    EXPECT_FALSE(any);
}

TEST(Driven, IsSuddenInTheStepInWhichAJetBegins) {
    FluidSetup s = metre_of_fluid();
    s.sources = {SourceSetup{.velocity_m_s = glm::dvec3(1.0, 0.0, 0.0), .start_s = 0.1}};
    Driven driven(s);
    driven.go_on({}, 0.09, 0.01);
    EXPECT_FALSE(driven.is_sudden()) << "a step that ends as it begins";
    driven.go_on({}, 0.1, 0.01);
    EXPECT_TRUE(driven.is_sudden());
    EXPECT_DOUBLE_EQ(driven.lately_m_s(), 1.0);
}

TEST(Driven, SeesASmallInlet) {
    FluidSetup s = metre_of_fluid();
    s.walls[0] = {.kind = WallKind::Inflow, .velocity_at = [](const glm::dvec3& x, double) {
                      return glm::length(x - glm::dvec3(0.0, 0.2, 0.2)) < 0.1 ? glm::dvec3(2.0, 0.0, 0.0)
                                                                              : glm::dvec3(0.0);
                  }};
    Driven driven(s);
    driven.go_on({}, 0.0, 0.01);
    EXPECT_DOUBLE_EQ(driven.lately_m_s(), 2.0);
}

TEST(Driven, MissesNoInletThatTheGridShows) {
    // Half a cell around the middle of one face; of the four that take turns, each.
    for (const glm::dvec2& middle :
         {glm::dvec2(0.45, 0.45), glm::dvec2(0.55, 0.45), glm::dvec2(0.45, 0.55), glm::dvec2(0.55, 0.55)})
        for (const bool steady : {true, false}) {
            FluidSetup s = metre_of_fluid();
            s.walls[3] = {.kind = WallKind::Inflow,
                          .velocity_at =
                              [middle, steady](const glm::dvec3& x, double t) {
                                  const bool runs = steady || (t > 0.1 && t < 0.2);
                                  return runs && glm::length(glm::dvec2(x.z, x.x) - middle) < 0.04
                                             ? glm::dvec3(0.0, -2.0, 0.0)
                                             : glm::dvec3(0.0);
                              },
                          .varies_in_time = !steady};
            Driven driven(s);
            int sudden = 0;
            for (int i = 0; i < 30; ++i) {
                driven.go_on({}, 0.01 * i, 0.01);
                sudden += driven.is_sudden();
            }
            EXPECT_DOUBLE_EQ(driven.through_gaps_m_s(0.01), 6.0);
            EXPECT_EQ(sudden, steady ? 0 : 2) << "as it begins and as it ends";
        }
}

TEST(Driven, LooksAtAWallAsOftenAsItVaries) {
    for (const bool in_space : {false, true})
        for (const bool in_time : {false, true}) {
            int looks = 0;
            FluidSetup s = metre_of_fluid();
            s.walls[0] = {.kind = WallKind::Inflow,
                          .velocity_at =
                              [&looks](const glm::dvec3&, double) {
                                  ++looks;
                                  return glm::dvec3(1.0, 0.0, 0.0);
                              },
                          .varies_in_space = in_space,
                          .varies_in_time = in_time};
            Driven driven(s);
            const int faces = in_space ? 100 : 1;
            EXPECT_EQ(looks, in_time ? 0 : faces);
            driven.go_on({}, 0.0, 0.01);
            EXPECT_EQ(looks, faces) << "the first step";
            looks = 0;
            for (int i = 1; i <= 4; ++i) driven.go_on({}, 0.01 * i, 0.01);
            EXPECT_EQ(looks, in_time ? 4 * faces : 0);
            EXPECT_DOUBLE_EQ(driven.lately_m_s(), 1.0);
        }
}

TEST(Driven, KnowsNoSpeedOfFluidThatMayFallOutOfTheTank) {
    FluidSetup s = metre_of_fluid();
    s.gravity_m_s2 = {0.0, -9.81, 0.0};
    EXPECT_EQ(Driven(s).lately_m_s(), 0.0);
    s.walls[2].kind = WallKind::Open;
    EXPECT_GE(Driven(s).lately_m_s(), 1e30);
}

TEST(Driven, GoesOnInAnotherFluidAsItDidInTheFirst) {
    FluidSetup s = metre_of_fluid();
    s.walls[0] = blowing([](double) { return 1.0; });
    Driven first(s), second(s), stranger(s);
    first.start(3.0);
    first.go_on({}, 0.0, 0.01);
    second.take_over(&first, 0.01);
    stranger.take_over(nullptr, 0.01);
    for (Driven* driven : {&first, &second, &stranger}) driven->go_on({}, 0.01, 0.01);
    EXPECT_EQ(second.lately_m_s(), first.lately_m_s());
    EXPECT_EQ(second.through_gaps_m_s(0.01), first.through_gaps_m_s(0.01));
    EXPECT_FALSE(second.is_sudden());
    EXPECT_FALSE(stranger.is_sudden());
    EXPECT_GE(stranger.through_gaps_m_s(0.01), 1e30) << "who knows";
}

TEST(Driven, AJetThatBeginsWhereAnotherFluidGoesOnIsSudden) {
    FluidSetup s = metre_of_fluid();
    s.sources = {SourceSetup{.velocity_m_s = glm::dvec3(1.0, 0.0, 0.0), .start_s = 0.01}};
    Driven first(s), second(s);
    first.start(0.0);
    first.go_on({}, 0.0, 0.01);
    second.take_over(&first, 0.01);
    second.go_on({}, 0.01, 0.01);
    EXPECT_TRUE(second.is_sudden());
}

TEST(Driven, AWallWithoutAValueRests) {
    for (const double none :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        FluidSetup s = metre_of_fluid();
        s.walls[0] = blowing([none](double) { return none; });
        Driven driven(s);
        driven.go_on({}, 0.0, 0.02);
        EXPECT_EQ(driven.lately_m_s(), 0.0) << none;
    }
}

}  // namespace
}  // namespace eddy::gles
