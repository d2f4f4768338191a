#include "firmware/quality/tuner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/fluid_setup.h"
#include "firmware/input_error.h"
#include "firmware/machine.h"
#include "firmware/render_setup.h"
#include "firmware/scene_grid.h"
#include "firmware/stopwatch.h"
#include "firmware/utc_stamp.h"
#include "gles/render/renderer.h"

namespace eddy {
namespace {

constexpr int kGrids[] = {16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128};
constexpr std::size_t kSteps = 60;
constexpr int kPictures = 5;
constexpr double kPictureHz = 30.0;
/// Pictures may take this share of the time; the rest is the fluid's.
constexpr double kMostForPictures = 0.4;

/// What a scene asks for is tried, too.
std::vector<int> with_own(std::vector<int> usual, int own) {
    if (std::find(usual.begin(), usual.end(), own) == usual.end())
        usual.insert(std::upper_bound(usual.begin(), usual.end(), own), own);
    return usual;
}

std::vector<int> iterations_for(const Scene& scene) {
    const bool sweeps = scene.solver.preset == SolverPreset::Yang2009;
    return with_own(sweeps ? std::vector{20, 40, 80} : std::vector{1, 2, 3}, quality_of(scene).iterations);
}

bool divides(const Scene& scene, int cells) {
    try {
        with_longest_side(scene, cells);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// The hand goes to and fro once a second.
void move_held(std::vector<gles::BodyState>& bodies, const BodySchedule& motions, const Scene& scene,
               double time_s) {
    const auto held = motions.held();
    if (!held) return;
    const double reach_m = 0.15 * scene.tank.size_m.x, w = 2.0 * std::numbers::pi;
    bodies[*held].centre_m = 0.5 * scene.tank.size_m;
    bodies[*held].centre_m.x += reach_m * std::sin(w * time_s);
    bodies[*held].velocity_m_s = {reach_m * w * std::cos(w * time_s), 0.0, 0.0};
}

}  // namespace

Tuner::Tuner(gles::Gpu& gpu, const Scene& scene)
    : gpu_(gpu),
      scene_(scene),
      half_width_share_(half_width_share(scene)),
      iterations_(iterations_for(scene)) {
    tuning_.version = EDDY_VERSION;
    tuning_.renderer = gpu.capabilities().renderer;
    tuning_.machine = describe_machine();
    tuning_.scene = print_scene(scene);
    tuning_.target_hz = 1.0 / scene.solver.dt_s;
    for (const int cells : kGrids)
        if (divides(scene, cells)) grids_.push_back(cells);
    grids_ = with_own(std::move(grids_), longest_side(scene));

    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, fluid_setup(scene));
    const std::vector<gles::BodyState> bodies = BodySchedule(scene).at(0.0, scene.solver.dt_s);
    gles::Renderer renderer(gpu, fluid->setup(), render_setup(scene));
    std::vector<double> picture_ms;
    for (int i = 0; i <= kPictures; ++i) {
        const double start = Stopwatch::now().wall_ms;
        renderer.draw(*fluid, bodies);
        if (i > 0) picture_ms.push_back(Stopwatch::now().wall_ms - start);  // the first compiles
    }
    tuning_.picture_ms = median(picture_ms);
    const double share = std::min(kMostForPictures, 1e-3 * tuning_.picture_ms * kPictureHz);
    tuning_.budget_ms = 1e3 * scene.solver.dt_s * (1.0 - share);
}

Quality Tuner::candidate() const {
    return {scene_.solver.preset, grids_[grid_], iterations_[series_]};
}

std::string Tuner::doing() const {
    return done() ? "" : describe(candidate());
}

void Tuner::work() {
    if (done()) return;
    if (!error_) error_.emplace(gpu_, scene_, candidate(), half_width_share_);
    if (!error_->done()) {
        error_->work();
    } else if (!fluid_) {
        make_fluid();
    } else {
        timer_->time_step();
        if (timer_->times().wall_ms.size() == kSteps) finish_candidate();
    }
}

void Tuner::make_fluid() {
    const Scene scene = with_quality(scene_, candidate());
    motions_.emplace(scene);
    fluid_ = gles::make_fluid(gpu_, fluid_setup(scene));
    timer_.emplace(
        gpu_, [this] { take_a_step(); }, [this] { fluid_->result(true); });
    timer_->warm_up();
}

void Tuner::take_a_step() {
    const double dt_s = scene_.solver.dt_s, time_s = static_cast<double>(fluid_->steps() + 1) * dt_s;
    std::vector<gles::BodyState> bodies = motions_->at(time_s, dt_s);
    move_held(bodies, *motions_, scene_, time_s);
    fluid_->step(dt_s, bodies, false);
}

void Tuner::finish_candidate() {
    const std::vector<double>& step_ms = timer_->times().wall_ms;
    const Rung rung{candidate(), median(step_ms), percentile_95(step_ms), error_->error()};
    tuning_.measured.push_back(rung);
    choose(tuning_);
    const double next =
        grid_ + 1 < grids_.size() ? static_cast<double>(grids_[grid_ + 1]) / grids_[grid_] : 1.0;
    error_.reset();
    timer_.reset();
    fluid_.reset();
    motions_.reset();
    gpu_.free_idle_textures();  // of this grid: all of them together would be hundreds of MB
    // Work grows with the cells, or more slowly.
    const double expected_ms = rung.step_ms * next * next;
    go_on(rung.step_ms > tuning_.budget_ms || expected_ms > 2.0 * tuning_.budget_ms);
}

void Tuner::go_on(bool too_slow) {
    ++grid_;
    if (!too_slow && grid_ < grids_.size()) return;
    grid_ = 0;
    ++series_;
    if (done() && tuning_.ladder.empty())
        throw std::runtime_error("tune: no setting gives a force that is a number");
    if (done()) tuning_.made_at = utc_stamp();
}

}  // namespace eddy
