#include <algorithm>

#include "tests/physics/tank.h"

namespace eddy::gles {
namespace {

using Forcing = GlTest;

TEST_F(Forcing, ThatIsAGradientMovesNothing) {
    // f = grad of x y + sin z: the pressure takes all of it; and a curl it cannot take.
    FluidSetup s = unit_tank({16, 14, 12}, 0.0, Advection::SemiLagrangian, 12);
    s.acceleration_m_s2 = VectorFormula{{"y", "x", "cos(z)"}};
    const auto fastest = [&] {
        const std::unique_ptr<Fluid> fluid = make_fluid(gpu, s);
        fluid->step(0.01, {}, false);
        double most = 0.0;
        for (const glm::vec3& u : fluid->velocity())
            most = std::max(most, static_cast<double>(glm::length(u)));
        return most;
    };
    EXPECT_LT(fastest(), 1e-5 * 0.01 * 16.0);
    s.acceleration_m_s2 = VectorFormula{{"y", "-x", "0.0"}};
    EXPECT_GT(fastest(), 0.1 * 0.01 * 16.0);
}

}  // namespace
}  // namespace eddy::gles
