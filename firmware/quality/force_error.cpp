#include "firmware/quality/force_error.h"

#include <algorithm>
#include <cmath>

#include "firmware/accuracy/convergence.h"
#include "firmware/fluid_setup.h"
#include "firmware/scene_grid.h"
#include "gles/body/bounds.h"

namespace eddy {
namespace {

/// Radius of the ball of case B2-box over the side of its tank.
constexpr double kBallOfB2 = 0.1;
/// The least grid that case is run on.
constexpr int kLeastBox = 8;
/// And the largest: a ball that is wider than its tenth is exact enough to tell nothing more.
constexpr int kLargestBox = 128;

}  // namespace

double half_width_share(const Scene& scene) {
    const auto is_held = [](const Scene::Body& body) { return body.motion == BodyMotion::Held; };
    const auto is_measured = [](const Scene::Body& body) { return body.force; };
    auto body = std::find_if(scene.bodies.begin(), scene.bodies.end(), is_held);
    if (body == scene.bodies.end())
        body = std::find_if(scene.bodies.begin(), scene.bodies.end(), is_measured);
    if (body == scene.bodies.end()) return kBallOfB2;
    const auto place = static_cast<std::size_t>(body - scene.bodies.begin());
    const gles::Extent extent = gles::extent(fluid_setup(scene).bodies[place].shape, body->orientation());
    const glm::dvec3 width = extent.high - extent.low, &size = scene.tank.size_m;
    return 0.5 * std::min({width.x, width.y, width.z}) / std::max({size.x, size.y, size.z});
}

ForceError::ForceError(gles::Gpu& gpu, const Scene& scene, const Quality& quality, double half_width_share)
    : gpu_(gpu), box_(load_scene("validation/B2-box").scene) {
    const double dt_s = box_.solver.dt_s;
    box_.solver = with_quality(scene, quality).solver;
    box_.solver.dt_s = dt_s;
    box_.solver.time_order = 1;
    const long cells = std::lround(quality.cells * half_width_share / kBallOfB2);
    box_ = with_longest_side(std::move(box_), std::clamp(static_cast<int>(cells), kLeastBox, kLargestBox));
}

void ForceError::work() {
    if (done()) return;
    if (!ball_) {
        ball_ = std::make_unique<accuracy::SetOff>(gpu_, box_, place_);
    } else if (!ball_->done()) {
        ball_->step();
    } else {
        error_ = accuracy::worse(error_, ball_->error());
        ball_.reset();
        ++place_;
    }
}

}  // namespace eddy
