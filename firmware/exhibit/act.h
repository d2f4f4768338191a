#pragma once
#include <functional>
#include <optional>
#include <string>

#include "firmware/gain_watch.h"
#include "firmware/hand_orders.h"
#include "firmware/quality/quality_control.h"
#include "firmware/rest_watch.h"
#include "firmware/show.h"
#include "firmware/stopwatch.h"
#include "firmware/views.h"

namespace eddy {

/// One step in this many is timed stage by stage and diagnosed; both make it wait for the GPU.
inline constexpr long kMeasureEvery = 20;

/// One scene on the exhibit: its fluid and with which quality it is computed, its picture, and how strongly it may push the hand. An
/// exhibit plays one after another: the next is made ready in pieces while the one before goes on. GL thread only.
class Act {
  public:
    struct Setup {
        QualityControl::Setup quality{};
        bool has_picture = true;  ///< pictures are drawn: what that needs is made ready too
        bool has_hand = true;     ///< somebody may hold the body
        bool shows_cost = false;  ///< the page "What does accuracy cost?" lies over the picture
    };
    /// Makes the first fluid. Throws gles::GlError if the scene asks for what this GPU has not.
    Act(gles::Gpu& gpu, const Scene& scene, HapticExchange& exchange, Setup setup);

    /// A piece of what is to be done before the act may begin: everything is drawn once, so that the driver compiles its shaders
    /// now. False when nothing is left.
    bool prepare();
    /// The share of the pieces that is done; that the act was made at all was the first.
    double prepared() const;
    /// From now on this act is played, and has a say in what the hand is told; `before`, if any, no more. There is no force until
    /// this fluid has answered.
    void begin(HandOrders& orders, const Act* before = nullptr);

    /// What is due at a time that is `interval` after the last: a step of the fluid, or rest. A change of quality is told
    /// in `news`.
    void go_on(Instant now, Seconds interval);
    /// In its place while it is closed, so that what moved the handle overnight is nobody's touch in the morning.
    void watch_hand(Instant now);
    /// Other work of this thread: it is not the fluid's fault when the next step is late for it. Returns what it took.
    Seconds beside_the_fluid(const std::function<void()>& work);
    /// Such work has taken so long.
    void was_elsewhere(Seconds took) { elsewhere_ += took; }
    /// Hands results that the GPU has finished to the haptic loop; with `wait`, the oldest in any case.
    void publish(bool wait);
    /// Draws the fluid as it is now, with a sentence under it, if any.
    const gles::Renderer& draw(Instant now, const std::string& caption = {});
    /// The gain follows the rate at which the fluid answers, and how late the loop has the answers.
    void adjust_gain(const LoopReport& report);
    /// Releases a latch whose cause is gone; a fluid that gave no numbers begins anew first.
    void release_latch(Instant now, const LoopReport& report);
    void show_cost(bool shown) { views_.show_cost(shown); }
    /// Back to the start of the scene. There is no force until the fluid has answered.
    void reset();

    Show& show() { return show_; }
    const Show& show() const { return show_; }
    const Scene& scene() const { return scene_; }
    const Stopwatch& stopwatch() const { return stopwatch_; }
    const GainWatch& gain() const { return gain_; }
    const RestWatch& watch() const { return watch_; }
    CostFigures cost() const;

    /// Lines for the log since the last call.
    std::vector<std::string> news() { return std::exchange(news_, {}); }

  private:
    void give_orders();
    /// As soon as there is an answer, from wherever it came.
    void give_force_back();
    void fluid_update(Instant now, Seconds dt);
    void change_quality(const QualityControl::Change& change, Instant now);
    /// What can wait until nobody is here.
    void use_the_quiet(Instant now);
    /// Fluid and picture of this quality, before they are shown.
    void make_ready(const Quality& quality, Instant now);

    gles::Gpu& gpu_;
    Scene scene_;
    Setup setup_;
    QualityControl quality_;
    Show show_;
    Stopwatch stopwatch_;
    StepRate step_rate_;
    RestWatch watch_;
    bool moves_by_itself_;
    Views views_;
    GainWatch gain_;
    std::vector<std::function<void()>> to_prepare_;  ///< the next last
    std::size_t pieces_;                             ///< that there were at first
    HandOrders* orders_ = nullptr;                   ///< while it is played
    std::uint64_t stale_answers_ = 0;                ///< up to this one, of before a beginning
    bool waits_for_answer_ = false;                  ///< for the first that is not, and with it the force
    Instant rest_ends_{0};
    Seconds elsewhere_{0.0};  ///< of the interval until the next update: spent beside the fluid,
    long steps_ = 1;          ///< and steps that the fluid takes in it
    std::vector<std::string> news_;
};

}  // namespace eddy
