#include "gles/fluid/contacts.h"

#include <gtest/gtest.h>

#include "gles/body/distance_grid.h"
#include "tests/gles/body/sample_meshes.h"

namespace eddy::gles {
namespace {

/// Balls of radius 1 m in a tank of 20 m, cells of 0.5 m. Masses 1, 2, 3 ... kg; number `held` is not solved for.
struct Balls {
    explicit Balls(std::vector<BodyState> where, std::optional<std::size_t> held = {})
        : states(std::move(where)), system(3 * (states.size() - (held ? 1 : 0))) {
        setup.cells = glm::ivec3(40);
        setup.cell_m = 0.5;
        setup.bodies.assign(states.size(), BodySetup{Sphere{1.0}});
        std::size_t next = 0;
        for (std::size_t i = 0; i < states.size(); ++i) {
            unknowns.push_back({i == held ? std::optional<std::size_t>() : next, {}});
            for (std::size_t k = 0; i != held && k < 3; ++k)
                system.a(next + k, next + k) = static_cast<double>(i + 1);
            if (i != held) next += 3;
        }
    }

    glm::dvec3 velocity(std::size_t i, const std::vector<double>& change) const {
        const std::size_t k = *unknowns[i].velocity;
        return states[i].velocity_m_s + glm::dvec3(change[k], change[k + 1], change[k + 2]);
    }

    FluidSetup setup;
    std::vector<BodyState> states;
    std::vector<Contacts::Unknowns> unknowns{};
    LinearSystem system;
};

BodyState at(const glm::dvec3& x, const glm::dvec3& v = glm::dvec3(0.0)) {
    return {.centre_m = x, .velocity_m_s = v};
}

TEST(Contacts, LeaveBodiesAloneThatHaveRoom) {
    Balls balls({at({5.0, 10.0, 10.0}, {1.0, 0.0, 0.0}), at({10.0, 10.0, 10.0})});
    Contacts contacts(balls.setup);
    for (const double change : contacts.solve(balls.system, balls.states, balls.unknowns, 0.1))
        EXPECT_EQ(change, 0.0);
    EXPECT_EQ(contacts.along(0, {3.0, 1.0, 2.0}), glm::dvec3(3.0, 1.0, 2.0));
}

TEST(Contacts, StopABodyOneCellBeforeTheWallAndLetItSlide) {
    Balls balls({at({1.6, 10.0, 10.0}, {-5.0, 2.0, 0.0})});
    Contacts contacts(balls.setup);
    const glm::dvec3 v = balls.velocity(0, contacts.solve(balls.system, balls.states, balls.unknowns, 0.1));
    EXPECT_NEAR(balls.states[0].centre_m.x + 0.1 * v.x, 1.5, 1e-8);
    EXPECT_EQ(v.y, 2.0);
    EXPECT_EQ(contacts.along(0, {3.0, 1.0, 2.0}), glm::dvec3(0.0, 1.0, 2.0));
}

TEST(Contacts, MakeBodiesThatMeetGoOnTogetherWithTheirMomentum) {
    Balls balls({at({8.0, 10.0, 10.0}, {3.0, 1.0, 0.0}), at({10.5, 10.0, 10.0})});  // one cell apart
    Contacts contacts(balls.setup);
    const auto change = contacts.solve(balls.system, balls.states, balls.unknowns, 0.1);
    const glm::dvec3 a = balls.velocity(0, change), b = balls.velocity(1, change);
    EXPECT_NEAR(a.x, 1.0, 2e-3);  // 1 kg at 3 m/s, and 2 kg
    EXPECT_NEAR(b.x, 1.0, 2e-3);
    EXPECT_NEAR(a.x + 2.0 * b.x, 3.0, 1e-12);
    EXPECT_EQ(a.y, 1.0) << "they slide along each other";
    for (const std::size_t first : {0, 3})
        EXPECT_EQ(contacts.along(first, {3.0, 1.0, 2.0}), glm::dvec3(0.0, 1.0, 2.0));
}

TEST(Contacts, MakeAHandPushWhatIsInItsWay) {
    Balls balls({at({10.5, 10.0, 10.0}), at({8.0, 10.0, 10.0}, {3.0, 0.0, 0.0})}, 1);
    Contacts contacts(balls.setup);
    const auto change = contacts.solve(balls.system, balls.states, balls.unknowns, 0.1);
    EXPECT_NEAR(balls.velocity(0, change).x, 3.0, 0.01);
}

TEST(Contacts, HaveAnAnswerForABodyBetweenHandAndWall) {
    Balls balls({at({18.5, 10.0, 10.0}), at({16.0, 10.0, 10.0}, {3.0, 0.0, 0.0})}, 1);
    Contacts contacts(balls.setup);
    const auto change = contacts.solve(balls.system, balls.states, balls.unknowns, 0.1);
    EXPECT_LT(glm::length(balls.velocity(0, change)), 1e-5);
}

TEST(Contacts, MoveBodiesOutOfEachOtherAndIntoTheTank) {
    Balls balls({at({10.0, 10.0, 10.0}), at({11.0, 10.0, 10.0}), at({30.0, 10.0, 10.0})});
    const Contacts contacts(balls.setup);
    contacts.separate(balls.states, balls.unknowns);
    EXPECT_NEAR(balls.states[0].centre_m.x, 9.25, 1e-12);
    EXPECT_NEAR(balls.states[1].centre_m.x, 11.75, 1e-12);
    EXPECT_NEAR(balls.states[2].centre_m.x, 18.5, 1e-12);
}

TEST(Contacts, KeepABodyInARoundContainer) {
    Balls balls({at({13.4, 10.0, 10.0}, {5.0, 0.0, 0.0}), at(glm::dvec3(10.0))}, 1);
    balls.setup.bodies[1] = {.shape = Sphere{5.0}, .inside_out = true};
    Contacts contacts(balls.setup);
    const auto change = contacts.solve(balls.system, balls.states, balls.unknowns, 0.1);
    EXPECT_NEAR(balls.velocity(0, change).x, 1.0, 0.01);  // 0.1 m left, in 0.1 s
}

TEST(Contacts, LetALongBodyCloserWithItsSideThanWithItsEnd) {
    for (const bool lies : {false, true}) {
        Balls balls({at({10.0, 10.0, 10.0}, {0.0, -1.0, 0.0}), at({10.0, 7.0, 10.0})}, 1);
        balls.setup.bodies[0].shape = Ellipsoid{{0.5, 2.0, 0.5}};
        if (lies) balls.states[0].orientation = glm::angleAxis(glm::radians(90.0), glm::dvec3(0.0, 0.0, 1.0));
        Contacts contacts(balls.setup);
        const auto change = contacts.solve(balls.system, balls.states, balls.unknowns, 0.1);
        EXPECT_NEAR(balls.velocity(0, change).y, lies ? -1.0 : 0.0, 0.01);
    }
}

TEST(Contacts, KeepTheMomentumOfABallThatSixOthersRunInto) {
    const glm::dvec3 middle(10.0), x(2.5, 0.0, 0.0), y(0.0, 2.5, 0.0), z(0.0, 0.0, 2.5);
    Balls balls({at(middle), at(middle - x, x), at(middle + x, -2.0 * x), at(middle - y, y),
                 at(middle + y, -3.0 * y), at(middle - z, 2.0 * z), at(middle + z, -z)});
    Contacts contacts(balls.setup);
    const auto change = contacts.solve(balls.system, balls.states, balls.unknowns, 0.1);
    glm::dvec3 before(0.0), after(0.0);
    for (std::size_t i = 0; i < balls.states.size(); ++i) {
        before += static_cast<double>(i + 1) * balls.states[i].velocity_m_s;
        after += static_cast<double>(i + 1) * balls.velocity(i, change);
    }
    EXPECT_NEAR(glm::length(after - before), 0.0, 1e-9 * glm::length(before));
}

TEST(Contacts, LetGoOfABallThatAnotherOnePushesAway) {
    // Ball 0 runs into ball 1; a hand, gliding by above, takes it back the way it came, faster. It may not take ball 1 along.
    Balls balls({at({10.0, 10.0, 10.0}, {1.0, 0.0, 0.0}), at({12.5, 10.0, 10.0}),
                 at({11.057, 12.266, 10.0}, {-10.0, 0.0, 0.0})},
                2);
    Contacts contacts(balls.setup);
    const auto change = contacts.solve(balls.system, balls.states, balls.unknowns, 0.1);
    EXPECT_LT(balls.velocity(0, change).x, -0.5);
    EXPECT_EQ(balls.velocity(1, change), glm::dvec3(0.0));
}

TEST(Contacts, LetGoOfAWallThatABallIsPushedAwayFrom) {
    // On its own it would go 0.6 m, 0.1 m too far; a hand from the wall's side hits it on its shoulder and stops it before.
    Balls balls({at({2.0, 10.0, 10.0}, {-6.0, 0.0, 0.0}), at({1.0, 12.3, 10.0}, {20.0, -3.0, 0.0})}, 1);
    Contacts contacts(balls.setup);
    const auto change = contacts.solve(balls.system, balls.states, balls.unknowns, 0.1);
    // 13.04 m/s along (0.3987, -0.9171) make hand and ball close no further than the 8 mm between them.
    EXPECT_NEAR(balls.velocity(0, change).x, -6.0 + 0.3987 * 13.04, 0.01);
}

TEST(Contacts, PartBallsThatAreAtOneAndTheSamePlace) {
    Balls balls({at(glm::dvec3(10.0)), at(glm::dvec3(10.0))});
    const Contacts contacts(balls.setup);
    contacts.separate(balls.states, balls.unknowns);
    EXPECT_NEAR(glm::distance(balls.states[0].centre_m, balls.states[1].centre_m), 2.5, 1e-12);
}

TEST(Contacts, LetALongRodCloseToAWallWithItsSide) {
    Balls balls({at({1.7, 10.0, 10.0}, {-5.0, 0.0, 0.0})});
    balls.setup.bodies[0].shape = Capsule{1.0, 16.9};  // half a cell too long to turn over
    Contacts contacts(balls.setup);
    contacts.separate(balls.states, balls.unknowns);
    EXPECT_EQ(balls.states[0].centre_m, glm::dvec3(1.7, 10.0, 10.0));
    const glm::dvec3 v = balls.velocity(0, contacts.solve(balls.system, balls.states, balls.unknowns, 0.1));
    EXPECT_NEAR(1.7 + 0.1 * v.x, 1.5, 1e-8);
}

TEST(Contacts, KeepTheEndOfATurningRodOutOfTheWall) {
    // Its spin is given: the centre must make way.
    Balls balls({at({1.5, 10.0, 10.0})});
    balls.setup.bodies[0].shape = Capsule{1.0, 8.0};
    balls.states[0].spin_rad_s = {0.0, 0.0, 1.0};
    Contacts contacts(balls.setup);
    const glm::dvec3 v = balls.velocity(0, contacts.solve(balls.system, balls.states, balls.unknowns, 0.1));
    EXPECT_NEAR(v.x, 4.0, 0.03);  // its arm is 4 m, and 2 cm more where it would lean
}

TEST(Contacts, TurnARodThatFallsOnItsEnd) {
    // A point at arm l from the centre of 1 kg and I that stops leaves the centre m l^2 / (I + m l^2) of its speed, and the
    // spin that goes with it.
    constexpr double kInertia = 2.0, kSpeed = 3.0, kHalf = 4.0;
    const glm::dquat leaning = glm::angleAxis(glm::radians(60.0), glm::dvec3(0.0, 0.0, 1.0));
    const double arm = (leaning * glm::dvec3(0.0, -kHalf, 0.0)).x;
    Balls balls({at({10.0, 1.5 + kHalf * 0.5, 10.0}, {0.0, -kSpeed, 0.0})});
    balls.setup.bodies[0].shape = Capsule{1.0, 2.0 * kHalf};
    balls.states[0].orientation = leaning;
    balls.unknowns[0].spin = 3;
    balls.system = LinearSystem(6);
    for (std::size_t k = 0; k < 3; ++k) {
        balls.system.a(k, k) = 1.0;
        balls.system.a(k + 3, k + 3) = kInertia / (0.5 * 0.5);  // of spins in m/s per cell
    }
    Contacts contacts(balls.setup);
    const std::vector<double> change = contacts.solve(balls.system, balls.states, balls.unknowns, 0.1);
    const double kept = arm * arm / (kInertia + arm * arm);
    EXPECT_NEAR(balls.velocity(0, change).y, -kSpeed * kept, 0.02 * kSpeed);
    EXPECT_NEAR(change[5] / 0.5 * arm, kSpeed * kept, 0.02 * kSpeed);
    EXPECT_EQ(change[0], 0.0) << "it slides";
}

TEST(Contacts, DoNotHangOnWhereAMeshHasItsOrigin) {
    // A cube, with its origin in its middle and 30 m from it: where it is stopped, at a wall and at a ball, is the same.
    const glm::dvec3 middle(10.0), far(30.0, 4.0, -20.0);
    const auto moved = [&](const glm::dvec3& origin, const glm::dvec3& where, const glm::dvec3& v) {
        Balls balls({at(where + origin, v), at({10.0, 6.0, 10.0})}, 1);
        balls.setup.bodies[0].shape =
            Mesh{std::make_shared<DistanceGrid>(box_mesh(-origin - 1.0, -origin + 1.0), 8)};
        Contacts contacts(balls.setup);
        contacts.separate(balls.states, balls.unknowns);
        return balls.states[0].centre_m - origin +
               0.1 * balls.velocity(0, contacts.solve(balls.system, balls.states, balls.unknowns, 0.1));
    };
    for (const glm::dvec3& origin : {glm::dvec3(0.0), far}) {
        const glm::dvec3 at_wall = moved(origin, {10.0, 17.0, 10.0}, {0.0, 50.0, 0.0});
        EXPECT_LT(glm::distance(at_wall, {10.0, 18.5, 10.0}), 1e-7);
        const glm::dvec3 at_ball = moved(origin, middle, {0.0, -50.0, 0.0});
        EXPECT_NEAR(at_ball.y, 8.5, 0.01);
        EXPECT_LT(glm::distance(moved(origin, middle, {1.0, 0.0, 0.0}), middle + glm::dvec3(0.1, 0.0, 0.0)),
                  1e-9);
    }
}

}  // namespace
}  // namespace eddy::gles
