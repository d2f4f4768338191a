#include "firmware/views.h"

#include "firmware/body_schedule.h"
#include "firmware/fluid_setup.h"
#include "firmware/scene_grid.h"
#include "tests/gles/gl_fixture.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

Scene smoky_tank() {
    return read_scene(
               "[tank]\ncells = [8, 8, 8]\n[smoke]\n[[body]]\nradius_m = 0.03\nmotion = \"held\"\n"
               "[render]\nwidth_px = 48\nheight_px = 32\n",
               "test.toml")
        .scene;
}

class ViewsTest : public gles::GlTest {
  protected:
    std::unique_ptr<gles::Fluid> fluid_on(int cells) {
        return gles::make_fluid(gpu, fluid_setup(with_longest_side(scene, cells)));
    }

    const Scene scene = smoky_tank();
    const std::vector<gles::BodyState> bodies = BodySchedule(scene).at(0.0, 0.02);
    int asked = 0;
    const std::function<CostFigures()> figures = [this] {
        ++asked;
        return CostFigures{};
    };
};

TEST_F(ViewsTest, FirstPictureOfAGridThatWasMadeReadyCompilesNothing) {
    Views views(gpu, scene, true);
    const auto coarse = fluid_on(8), fine = fluid_on(12);
    views.make_ready(*coarse, bodies, 0s, figures);
    const std::size_t after_coarse = gpu.programs().linked();
    views.make_ready(*fine, bodies, 0s, figures);
    const std::size_t ready = gpu.programs().linked();
    EXPECT_GT(ready, after_coarse) << "each grid has programs of its own";
    views.of(*fine).draw(*fine, bodies, 1s, figures);
    views.of(*coarse).draw(*coarse, bodies, 1s, figures);
    EXPECT_EQ(gpu.programs().linked(), ready);
}

TEST_F(ViewsTest, GridThatIsReadyIsNotDrawnAgain) {
    Views views(gpu, scene, true);
    const auto fluid = fluid_on(8);
    for (int i = 0; i < 3; ++i) views.make_ready(*fluid, bodies, i * 10s, figures);
    EXPECT_EQ(asked, 1);
}

TEST_F(ViewsTest, PictureOfAGridIsOneHoweverItIsComputed) {
    Views views(gpu, scene, false);
    const auto one = fluid_on(8), other = fluid_on(8), finer = fluid_on(12);
    EXPECT_EQ(&views.of(*one), &views.of(*other));
    EXPECT_NE(&views.of(*one), &views.of(*finer));
}

}  // namespace
}  // namespace eddy
