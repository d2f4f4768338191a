#include "firmware/quality/tuner.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

#include "firmware/accuracy/convergence.h"
#include "firmware/fluid_setup.h"
#include "firmware/input_error.h"
#include "firmware/machine.h"
#include "firmware/render_setup.h"
#include "firmware/scene_grid.h"
#include "firmware/stopwatch.h"
#include "gles/body/bounds.h"
#include "gles/render/renderer.h"

namespace eddy {
namespace {

constexpr int kGrids[] = {16, 24, 32, 40, 48, 56, 64, 80, 96, 112, 128};
constexpr int kWarmUp = 5, kSteps = 60;
constexpr int kPictures = 5;
constexpr double kPictureHz = 30.0;
/// Pictures may take this share of the time; the rest is the fluid's.
constexpr double kMostForPictures = 0.4;

/// Radius of the ball of case B2-box over the side of its tank.
constexpr double kBallOfB2 = 0.1;
/// The least grid that case is run on.
constexpr int kLeastBox = 8;

int iterations_of(SolverPreset preset, std::size_t series) {
    constexpr int kSweeps[] = {20, 40, 80};
    return preset == SolverPreset::Yang2009 ? kSweeps[series] : static_cast<int>(series) + 1;
}

bool divides(const Scene& scene, int cells) {
    try {
        with_longest_side(scene, cells);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// Half the least width of the body in the hand, or of the first whose force is measured; that of the ball of B2 without any.
double half_width_m(const Scene& scene, const gles::FluidSetup& fluid) {
    const auto of = [&](const auto& wanted) -> std::optional<double> {
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            if (!wanted(scene.bodies[i])) continue;
            const gles::Extent e = gles::extent(fluid.bodies[i].shape, scene.bodies[i].orientation());
            const glm::dvec3 width = e.high - e.low;
            return 0.5 * std::min({width.x, width.y, width.z});
        }
        return std::nullopt;
    };
    const glm::dvec3& size = scene.tank.size_m;
    if (const auto held = of([](const Scene::Body& body) { return body.motion == BodyMotion::Held; }))
        return *held;
    return of([](const Scene::Body& body) { return body.force; })
        .value_or(kBallOfB2 * std::max({size.x, size.y, size.z}));
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

Tuner::Tuner(gles::Gpu& gpu, const Scene& scene) : gpu_(gpu), scene_(scene) {
    tuning_.version = EDDY_VERSION;
    tuning_.renderer = gpu.capabilities().renderer;
    tuning_.machine = describe_machine();
    tuning_.scene = print_scene(scene);
    tuning_.target_hz = 1.0 / scene.solver.dt_s;
    for (const int cells : kGrids)
        if (divides(scene, cells)) grids_.push_back(cells);
    if (const int own = longest_side(scene); std::find(grids_.begin(), grids_.end(), own) == grids_.end())
        grids_.insert(std::upper_bound(grids_.begin(), grids_.end(), own), own);

    const std::unique_ptr<gles::Fluid> fluid = gles::make_fluid(gpu, fluid_setup(scene));
    const std::vector<gles::BodyState> bodies = BodySchedule(scene).at(0.0, scene.solver.dt_s);
    ball_share_ = half_width_m(scene, fluid->setup()) / (fluid->setup().cell_m * longest_side(scene));
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
    const SolverPreset preset = scene_.solver.preset;
    return {preset, grids_[grid_], iterations_of(preset, series_)};
}

std::string Tuner::doing() const {
    return done() ? "" : describe(candidate());
}

void Tuner::work() {
    if (done()) return;
    if (places_done_ < accuracy::SetOff::kPlaces) {
        if (!ball_) {
            Scene box = load_scene("validation/B2-box").scene;
            const double dt_s = box.solver.dt_s;
            box.solver = with_quality(scene_, candidate()).solver;
            box.solver.dt_s = dt_s;
            box.solver.time_order = 1;
            ball_ = std::make_unique<accuracy::SetOff>(
                gpu_, with_longest_side(std::move(box), candidate().cells), places_done_);
        } else if (!ball_->done()) {
            ball_->step();
        } else {
            error_ = accuracy::worse(error_, ball_->error());
            ball_.reset();
            ++places_done_;
        }
    } else if (!fluid_) {
        const Scene scene = with_quality(scene_, candidate());
        motions_.emplace(scene);
        fluid_ = gles::make_fluid(gpu_, fluid_setup(scene));
        time_a_step();
    } else {
        time_a_step();
        if (step_ms_.size() == kWarmUp + kSteps) finish_candidate();
    }
}

void Tuner::time_a_step() {
    const double dt_s = scene_.solver.dt_s, time_s = static_cast<double>(fluid_->steps() + 1) * dt_s;
    std::vector<gles::BodyState> bodies = motions_->at(time_s, dt_s);
    move_held(bodies, *motions_, scene_, time_s);
    const double start = Stopwatch::now().wall_ms;
    fluid_->step(dt_s, bodies, false);
    step_ms_.push_back(Stopwatch::now().wall_ms - start);
    fluid_->result(false);
}

void Tuner::finish_candidate() {
    step_ms_.erase(step_ms_.begin(), step_ms_.begin() + kWarmUp);
    const Rung rung{candidate(), median(step_ms_), percentile_95(step_ms_), error_};
    tuning_.measured.push_back(rung);
    choose(tuning_);
    const double next =
        grid_ + 1 < grids_.size() ? static_cast<double>(grids_[grid_ + 1]) / grids_[grid_] : 1.0;
    places_done_ = 0;
    error_ = 0.0;
    fluid_.reset();
    motions_.reset();
    step_ms_.clear();
    // Work grows with the cells, or more slowly.
    const double expected_ms = rung.step_ms * next * next;
    go_on(rung.step_ms > tuning_.budget_ms || expected_ms > 2.0 * tuning_.budget_ms);
}

void Tuner::go_on(bool too_slow) {
    ++grid_;
    if (!too_slow && grid_ < grids_.size()) return;
    grid_ = 0;
    ++series_;
    if (done()) tuning_.made_at = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace eddy
