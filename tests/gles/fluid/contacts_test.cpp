#include "gles/fluid/contacts.h"

#include <gtest/gtest.h>

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
            unknowns.push_back(i == held ? std::optional<std::size_t>() : next);
            for (std::size_t k = 0; i != held && k < 3; ++k)
                system.a(next + k, next + k) = static_cast<double>(i + 1);
            if (i != held) next += 3;
        }
    }

    glm::dvec3 velocity(std::size_t i, const std::vector<double>& change) const {
        const std::size_t k = *unknowns[i];
        return states[i].velocity_m_s + glm::dvec3(change[k], change[k + 1], change[k + 2]);
    }

    FluidSetup setup;
    std::vector<BodyState> states;
    std::vector<std::optional<std::size_t>> unknowns{};
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
    EXPECT_FALSE(contacts.stopped(0));
}

TEST(Contacts, StopABodyOneCellBeforeTheWallAndLetItSlide) {
    Balls balls({at({1.6, 10.0, 10.0}, {-5.0, 2.0, 0.0})});
    Contacts contacts(balls.setup);
    const glm::dvec3 v = balls.velocity(0, contacts.solve(balls.system, balls.states, balls.unknowns, 0.1));
    EXPECT_NEAR(balls.states[0].centre_m.x + 0.1 * v.x, 1.5, 1e-12);
    EXPECT_EQ(v.y, 2.0);
    EXPECT_TRUE(contacts.stopped(0));
    EXPECT_FALSE(contacts.stopped(1));
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
    EXPECT_EQ(balls.velocity(0, change), glm::dvec3(0.0));
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

}  // namespace
}  // namespace eddy::gles
