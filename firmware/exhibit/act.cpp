#include "firmware/exhibit/act.h"

#include <fmt/format.h>

#include <algorithm>

namespace eddy {
namespace {

using namespace std::chrono_literals;

/// A fluid step covers the time since the last one, but never more than this: after a stall the fluid loses time instead of
/// leaping. Where steps take so long by habit, or the scene wants them so, it is no stall: the hand's body would never move.
constexpr Seconds kLongestStep{0.1};
constexpr double kOfTheUsual = 1.5;
/// Of each stage's times; the page and the summary take their median.
constexpr std::size_t kSamples = 200;
/// While nothing moves the fluid is computed this often, to see whether that is still so.
constexpr Instant kRestPeriod = 500ms;
/// How much more of a body's movement is seen than of as fast a fluid: one that sinks in thick fluid goes so slowly.
constexpr double kOfBodies = 10.0;

double longest_side_m(const Scene& scene) {
    const glm::dvec3& size_m = scene.tank.size_m;
    return std::max({size_m.x, size_m.y, size_m.z});
}

}  // namespace

Act::Act(gles::Gpu& gpu, const Scene& scene, HapticExchange& exchange, Setup setup)
    : gpu_(gpu),
      scene_(scene),
      setup_(std::move(setup)),
      quality_(gpu, scene, setup_.quality),
      show_(gpu, scene, exchange, quality_.first()),
      stopwatch_(gpu),
      watch_(longest_side_m(scene), scene.haptics.workspace_scale),
      moves_by_itself_(moves_by_itself(scene)),
      views_(gpu, scene, setup_.shows_cost),
      gain_(scene.haptics.gain, scene.haptics.workspace_scale) {
    stopwatch_.keep_last(kSamples);
    if (setup_.has_hand) to_prepare_.push_back([this] { gain_.learn(show_.slopes()); });
    for (const Quality& quality : quality_.all())
        to_prepare_.push_back([this, quality] { make_ready(quality, Instant(0)); });
    to_prepare_.push_back([this] { show_.warm_up(quality_.all()); });
    pieces_ = 1 + to_prepare_.size();
}

double Act::prepared() const {
    return 1.0 - static_cast<double>(to_prepare_.size()) / static_cast<double>(pieces_);
}

bool Act::prepare() {
    if (to_prepare_.empty()) return false;
    to_prepare_.back()();
    to_prepare_.pop_back();
    gpu_.finish();
    return !to_prepare_.empty();
}

void Act::begin(HandOrders& orders, const Act* before) {
    orders_ = &orders;
    if (before) show_.follow(before->show_);
    stale_answers_ = show_.answers();
    gain_.see(Seconds(scene_.solver.dt_s));
    give_orders();
}

void Act::reset() {
    show_.reset();
    stale_answers_ = show_.answers();
    rest_ends_ = Instant(0);  // what it rests from is over
    give_orders();
}

void Act::publish(bool wait) {
    show_.publish(wait);
    give_force_back();
}

void Act::give_force_back() {
    if (waits_for_answer_ && show_.answers() > stale_answers_) give_orders();
}

/// The hand may go as far as the coarsest grid lets it.
void Act::give_orders() {
    Quality coarsest = quality_.first();
    for (const Quality& quality : quality_.all())
        if (quality.cells < coarsest.cells) coarsest = quality;
    HapticOrders orders = orders_for(with_quality(scene_, coarsest), show_.fluid().setup());
    orders.gain = gain_.gain();
    orders.most_n = scene_.haptics.max_force_n;
    orders.enabled = show_.answers() > stale_answers_;
    waits_for_answer_ = !orders.enabled;
    show_.set_gain(orders.gain);
    orders_->give(orders);
}

void Act::make_ready(const Quality& quality, Instant now) {
    const gles::Fluid& fluid = show_.make_ready(quality);
    if (setup_.has_picture) views_.make_ready(fluid, show_.bodies(), now, [this] { return cost(); });
}

CostFigures Act::cost() const {
    CostFigures figures = cost_figures(scene_, show_, stopwatch_, step_rate_);
    figures.force_error = quality_.force_error(show_.quality());
    figures.quality_down = quality_.steps_down();
    figures.quality_up = quality_.steps_up();
    figures.quality_note = quality_.note();
    return figures;
}

void Act::watch_hand(Instant now) {
    const PoseSnapshot& pose = show_.pose();
    watch_.see(now, pose.known ? std::optional(pose.position_m) : std::nullopt, pose.buttons);
}

void Act::go_on(Instant now, Seconds interval) {
    const Seconds elsewhere = std::exchange(elsewhere_, Seconds(0.0));
    watch_hand(now);
    if (auto speed_m_s = show_.figures().fluid_speed_m_s; speed_m_s && !moves_by_itself_) {
        for (const gles::BodyState& body : show_.bodies())
            speed_m_s = std::max(*speed_m_s, kOfBodies * glm::length(body.velocity_m_s));
        watch_.all_moves_at(*speed_m_s);
    }
    if (watch_.nobody_here()) beside_the_fluid([&] { use_the_quiet(now); });
    if (watch_.may_rest() && now < rest_ends_) {
        show_.rest(now);
        return;
    }
    rest_ends_ = now + kRestPeriod;
    const QualityControl::Interval since_last{interval, elsewhere, steps_};
    fluid_update(now, std::min(interval, std::max(kLongestStep, kOfTheUsual * show_.usual_step())));
    give_force_back();
    if (const auto change = quality_.update(now, since_last, show_.pose().buttons))
        change_quality(*change, now);
}

Seconds Act::beside_the_fluid(const std::function<void()>& work) {
    gpu_.finish();  // of the fluid's step: that is its own
    const RealClock clock;
    work();
    const Seconds took = clock.now();
    was_elsewhere(took);
    return took;
}

void Act::fluid_update(Instant now, Seconds dt) {
    const bool measure = show_.figures().steps % kMeasureEvery == kMeasureEvery / 2 || watch_.may_rest();
    stopwatch_.set_on(measure);
    // Not the same step: to look into one takes time.
    const bool time = show_.figures().steps % kMeasureEvery == 0;
    const double start_ms = time ? Stopwatch::now().wall_ms : 0.0;
    const long before = show_.fluid().steps();
    show_.update(now, dt, measure);
    steps_ = std::max(show_.fluid().steps() - before, 1L);
    if (time) gpu_.finish();
    if (time && !measure)
        quality_.step_took((Stopwatch::now().wall_ms - start_ms) / static_cast<double>(steps_));
    step_rate_.add_step();
    stopwatch_.set_on(false);
}

void Act::change_quality(const QualityControl::Change& change, Instant now) {
    make_ready(change.quality, now);
    show_.set_quality(change.quality);
    give_orders();
    stopwatch_.forget();
    news_.push_back(fmt::format("{} from now on: {}", describe(change.quality), change.reason));
}

void Act::use_the_quiet(Instant now) {
    for (const Quality& quality : quality_.all())
        if (!show_.is_ready(quality)) {
            make_ready(quality, now);
            give_orders();
            return;
        }
    if (const auto text = quality_.work()) news_.push_back(*text);
}

const gles::Renderer& Act::draw(Instant now, const std::string& caption) {
    stopwatch_.set_on(true);
    View& view = views_.of(show_.fluid());
    view.draw(
        show_.fluid(), show_.bodies(), now, [this] { return cost(); }, caption);
    stopwatch_.set_on(false);
    return view.renderer();
}

void Act::adjust_gain(const LoopReport& report) {
    if (!setup_.has_hand || show_.figures().steps == 0) return;
    if (gain_.see(Seconds(show_.figures().fluid_period_s), report.fluid_lateness)) give_orders();
    if (const auto news = gain_.news()) news_.push_back(*news);
}

void Act::release_latch(Instant now, const LoopReport& report) {
    const std::optional<GateReason> cause = orders_->cause_gone(now, report);
    if (!cause) return;
    if (*cause == GateReason::NotFinite) reset();
    orders_->release_latch();
}

}  // namespace eddy
