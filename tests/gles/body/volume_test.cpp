#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "gles/body/distance_grid.h"
#include "gles/body/fractions.h"
#include "gles/grid_io.h"
#include "tests/gles/body/sample_meshes.h"
#include "tests/gles/body/shape_reference.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::gles {
namespace {

constexpr const char* kWithEdges[] = {"cuboid", "cylinder", "disk", "paddle", "tetrahedron"};

/// What face fractions think of the volume of a body, in cells of 1 m: 1 - a summed over the faces that
/// gravity crosses, which is exactly the buoyancy it gets, as Archimedes says.
class Volume : public GlTest {
  protected:
    /// Relative error, the worst of some poses.
    double worst_error(const Shape& shape) {
        const std::vector<BodySetup> bodies{{shape}};
        const double exact = mass_properties(shape).volume_m3;
        Fractions fractions(gpu, {n}, bodies, 1.0);
        BodyUniforms uniforms(gpu, bodies, 1.0);
        double worst = 0.0;
        for (int pose = 0; pose < 4; ++pose) {
            BodyState state;
            state.centre_m = random_point(random, 7.5, 8.5);
            if (pose > 0) state.orientation = random_turn(random);
            uniforms.set({state});
            fractions.update(uniforms, {body_box(bodies[0], state, 1.0, n)});
            const Field<Faces4>& y = fractions.level(0).y;
            double solid = 0.0;
            for (const float a : unpack_four(y.texture().download(), y.layout(), n + 1)) solid += 1.0 - a;
            if (std::abs(solid / exact - 1.0) > std::abs(worst)) worst = solid / exact - 1.0;
        }
        return worst;
    }

    const glm::ivec3 n{16, 16, 16};
    Random random{11};
};

bool has_edges(const NamedShape& named) {
    return std::count(std::begin(kWithEdges), std::end(kWithEdges), named.name) > 0;
}

TEST_F(Volume, OfASmoothShapeIsKeptWithinOnePercentInEveryPose) {
    for (const NamedShape& named : closed_form_shapes())
        if (!has_edges(named)) {
            EXPECT_LT(std::abs(worst_error(named.shape)), 0.01) << named.name;
        }
    // Linear between nodes a spacing h apart, the ball's surface lies h^2 / 4 R too far in: 0.5 % of volume.
    const Mesh ball{std::make_shared<DistanceGrid>(icosphere(3.0, 4), 32, 1.5)};
    EXPECT_LT(std::abs(worst_error(ball)), 0.01);
}

TEST_F(Volume, OfAShapeWithEdgesIsKeptWithinThreePercentInEveryPose) {
    for (const NamedShape& named : closed_form_shapes())
        if (has_edges(named)) {
            EXPECT_LT(std::abs(worst_error(named.shape)), 0.03) << named.name;
        }
    const Mesh box{std::make_shared<DistanceGrid>(box_mesh({-2.0, -3.5, -1.25}, {2.0, 3.5, 1.25}), 48, 1.5)};
    EXPECT_LT(std::abs(worst_error(box)), 0.03);
}

}  // namespace
}  // namespace eddy::gles
