#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <functional>
#include <thread>

#include "config/scene.h"
#include "firmware/destination.h"
#include "firmware/flight_keeper.h"
#include "firmware/gain_watch.h"
#include "firmware/graphics.h"
#include "firmware/hand_orders.h"
#include "firmware/haptic/loop.h"
#include "firmware/haptic/realtime.h"
#include "firmware/progress.h"
#include "firmware/quality/quality_control.h"
#include "firmware/recorder.h"
#include "firmware/rest_watch.h"
#include "firmware/show.h"
#include "firmware/status.h"
#include "firmware/stopwatch.h"
#include "firmware/text_file.h"
#include "firmware/verbs/run_device.h"
#include "firmware/verbs/run_options.h"
#include "firmware/verbs/stop.h"
#include "firmware/views.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

/// A fluid step covers the time since the last one, but never more: after a stall the fluid loses time
/// instead of leaping.
constexpr Seconds kLongestStep{0.1};
constexpr Seconds kSlowWarmUp{2.0};  // worth a line
/// Of each stage's times; the page and the summary take their median.
constexpr std::size_t kSamples = 200;
/// While nothing moves the fluid is computed this often, to see whether that is still so.
constexpr Instant kRestPeriod = 500ms;
/// One step in this many is timed stage by stage and diagnosed; both make it wait for the GPU.
constexpr long kMeasureEvery = 20;
/// Recording pictures may take this share of the time; the fluid has the rest.
constexpr double kRenderShare = 0.4;

/// Everything one run holds, wired together.
class Run {
  public:
    Run(const RunOptions& options, const Exhibit& exhibit, const Scene& scene, RunDevice device,
        std::unique_ptr<Graphics> graphics)
        : options_(options),
          scene_(scene),
          device_(std::move(device.device)),
          device_name_(std::move(device.name)),
          graphics_(std::move(graphics)),
          quality_(graphics_->gpu, scene, quality_setup(options, exhibit, scene)),
          show_(graphics_->gpu, scene, exchange_, quality_.first()),
          stopwatch_(graphics_->gpu),
          watch_(std::max({scene.tank.size_m.x, scene.tank.size_m.y, scene.tank.size_m.z})),
          moves_by_itself_(moves_by_itself(scene)),
          trace_(20000),
          views_(graphics_->gpu, scene, options.overlay.value_or(exhibit.overlay) == OverlayChoice::Cost) {
        if (!options.record.empty()) recorder_.emplace(options.record);
        stopwatch_.keep_last(kSamples);
        HapticLoopSettings settings;
        settings.law = exhibit.force == ForceChoice::Filter ? ForceLaw::Filter : ForceLaw::Model;
        settings.gate.max_force_n = std::min(scene.haptics.max_force_n, exhibit.max_force_n);
        if (device_) {
            flights_ = std::make_unique<FlightRecorder>(settings);
            loop_.emplace(*device_, exchange_, trace_, settings, flights_.get());
            keep_flights(options.state_dir.empty() ? exhibit.state_dir
                                                   : std::filesystem::path(options.state_dir));
        }
        give_orders();
        // status.json goes where it is asked for; by default to the run folder of the service, if there is
        // one.
        const std::filesystem::path folder =
            options.run_dir.empty() ? exhibit.run_dir : std::filesystem::path(options.run_dir);
        if (is_folder(folder)) status_file_ = folder / "status.json";
    }

    /// Draws everything once, before the clock starts.
    void warm_up();
    void real();
    void stepped();
    /// Completes the recording.
    void finish() {
        progress_.finish();
        if (recorder_) recorder_->finish();
        if (flight_keeper_) flight_keeper_->finish();
        tell_of_flights();
    }
    bool recording_failed() const { return recording_failed_; }
    /// Ten lines on standard output.
    void summarise() const;

  private:
    Instant end() const {
        return options_.seconds ? std::chrono::duration_cast<Instant>(Seconds(*options_.seconds))
                                : Instant::max();
    }
    /// The hand may go as far as the coarsest grid lets it.
    void give_orders();
    void tell_of_flights();
    void keep_flights(const std::filesystem::path& state_dir);
    /// What is due at a time that is `interval` after the last: a step of the fluid, or rest.
    void go_on(Instant now, Seconds interval);
    void fluid_update(Instant now, Seconds dt);
    /// Other work of this thread: it is not the fluid's fault when the next step is late for it. Returns what it took.
    Seconds beside_the_fluid(const std::function<void()>& work);
    void change_quality(const QualityControl::Change& change, Instant now);
    /// What can wait until nobody is here.
    void use_the_quiet(Instant now);
    /// Fluid and picture of this quality, before they are shown.
    void make_ready(const Quality& quality, Instant now);
    void record_frame(Instant now);
    CostFigures cost() const;
    void drain_trace();
    void report(Instant now, bool force = false);

    RunOptions options_;
    Scene scene_;
    std::unique_ptr<HapticDevice> device_;
    std::string
        device_name_;  // with its state once the loop has ended: only the loop's thread may ask the device
    HapticExchange exchange_;
    std::unique_ptr<Graphics> graphics_;
    QualityControl quality_;
    Show show_;
    Stopwatch stopwatch_;
    StepRate step_rate_;
    RestWatch watch_;
    bool moves_by_itself_;
    Instant rest_ends_{0};
    Seconds elsewhere_{0.0};  ///< of the interval until the next update: spent beside the fluid,
    long steps_ = 1;          ///< and steps that the fluid takes in it
    TickTrace trace_;
    std::vector<TickRecord> ticks_{4096};
    std::unique_ptr<FlightRecorder> flights_;
    std::optional<HapticLoop> loop_;
    std::optional<FlightKeeper> flight_keeper_;
    Views views_;
    std::optional<Recorder> recorder_;
    std::filesystem::path status_file_;
    HandOrders orders_{exchange_};
    GainWatch gain_{scene_.haptics.gain, scene_.haptics.workspace_scale};
    Instant status_due_{0}, frame_due_{0};
    bool recording_failed_ = false;
    double sent_most_n_ = 0.0;
    LoopReport loop_report_;
    double clock_s_ = 0.0, wall_s_ = 0.0;
    Progress progress_{"run"};
};

/// Of faults that happen. Where the exhibit keeps nothing else, it keeps no flights either.
void Run::keep_flights(const std::filesystem::path& state_dir) {
    if (is_folder(state_dir)) flight_keeper_.emplace(*flights_, state_dir / "flights");
}

void Run::tell_of_flights() {
    if (const auto news = flight_keeper_ ? flight_keeper_->news() : std::nullopt)
        fmt::print(stderr, "run: {}\n", *news);
}

void Run::give_orders() {
    Quality coarsest = quality_.first();
    for (const Quality& quality : quality_.all())
        if (quality.cells < coarsest.cells) coarsest = quality;
    HapticOrders orders = orders_for(with_quality(scene_, coarsest), show_.fluid().setup());
    orders.gain = gain_.gain();
    show_.set_gain(orders.gain);
    orders_.give(orders);
}

void Run::warm_up() {
    const RealClock clock;
    show_.warm_up(quality_.all());
    for (const Quality& quality : quality_.all()) make_ready(quality, Instant(0));
    if (loop_) gain_.learn(show_.slopes());
    gain_.see(Seconds(scene_.solver.dt_s));
    give_orders();
    gles::finish();
    if (const Seconds took = clock.now(); took > kSlowWarmUp)
        fmt::print(stderr, "run: the driver took {:.1f} s to prepare its shaders\n", took.count());
}

void Run::make_ready(const Quality& quality, Instant now) {
    const gles::Fluid& fluid = show_.make_ready(quality);
    if (recorder_) views_.make_ready(fluid, show_.bodies(), now, [this] { return cost(); });
}

CostFigures Run::cost() const {
    CostFigures figures = cost_figures(scene_, show_, stopwatch_, step_rate_);
    figures.force_error = quality_.force_error(show_.quality());
    figures.quality_down = quality_.steps_down();
    figures.quality_up = quality_.steps_up();
    figures.quality_note = quality_.note();
    return figures;
}

void Run::go_on(Instant now, Seconds interval) {
    const Seconds elsewhere = std::exchange(elsewhere_, Seconds(0.0));
    const PoseSnapshot pose = exchange_.pose.newest();
    watch_.see(now, pose.known ? std::optional(pose.position_m) : std::nullopt, pose.buttons);
    if (auto speed_m_s = show_.figures().fluid_speed_m_s; speed_m_s && !moves_by_itself_) {
        for (const gles::BodyState& body : show_.bodies())
            speed_m_s = std::max(*speed_m_s, glm::length(body.velocity_m_s));
        watch_.all_moves_at(*speed_m_s);
    }
    if (watch_.nobody_here()) beside_the_fluid([&] { use_the_quiet(now); });
    if (watch_.may_rest() && now < rest_ends_) {
        show_.rest(now);
        return;
    }
    rest_ends_ = now + kRestPeriod;
    const QualityControl::Interval since_last{interval, elsewhere, steps_};
    fluid_update(now, std::min(interval, kLongestStep));
    if (const auto change = quality_.update(now, since_last, pose.buttons)) change_quality(*change, now);
}

Seconds Run::beside_the_fluid(const std::function<void()>& work) {
    gles::finish();  // of the fluid's step: that is its own
    const RealClock clock;
    work();
    const Seconds took = clock.now();
    elsewhere_ += took;
    return took;
}

void Run::fluid_update(Instant now, Seconds dt) {
    const bool measure = show_.figures().steps % kMeasureEvery == kMeasureEvery / 2 || watch_.may_rest();
    stopwatch_.set_on(measure);
    // Not the same step: to look into one takes time.
    const bool time = show_.figures().steps % kMeasureEvery == 0;
    const double start_ms = time ? Stopwatch::now().wall_ms : 0.0;
    const long before = show_.fluid().steps();
    show_.update(now, dt, measure);
    steps_ = std::max(show_.fluid().steps() - before, 1L);
    if (time && !measure)
        quality_.step_took((Stopwatch::now().wall_ms - start_ms) / static_cast<double>(steps_));
    step_rate_.add_step();
    stopwatch_.set_on(false);
}

void Run::change_quality(const QualityControl::Change& change, Instant now) {
    make_ready(change.quality, now);
    show_.set_quality(change.quality);
    give_orders();
    stopwatch_.forget();
    fmt::print(stderr, "run: {} from now on: {}\n", describe(change.quality), change.reason);
}

void Run::use_the_quiet(Instant now) {
    for (const Quality& quality : quality_.all())
        if (!show_.is_ready(quality)) {
            make_ready(quality, now);
            give_orders();
            return;
        }
    if (const auto text = quality_.work()) fmt::print(stderr, "run: {}\n", *text);
}

void Run::record_frame(Instant now) {
    stopwatch_.set_on(true);
    View& view = views_.of(show_.fluid());
    view.draw(show_.fluid(), show_.bodies(), now, [this] { return cost(); });
    stopwatch_.set_on(false);
    try {
        recorder_->add(view.renderer(), scene_.render.width_px, scene_.render.height_px);
    } catch (const std::runtime_error& e) {
        // A full disk must not stop the show.
        fmt::print(stderr, "recording stopped: {}\n", e.what());
        recorder_.reset();
        recording_failed_ = true;
    }
}

void Run::drain_trace() {
    while (const std::size_t count = trace_.drain(ticks_)) {
        for (std::size_t i = 0; i < count; ++i)
            sent_most_n_ = std::max(sent_most_n_, glm::length(ticks_[i].sent_force_n));
        if (recorder_) recorder_->add({ticks_.data(), count});
    }
}

void Run::report(Instant now, bool force) {
    loop_report_ = exchange_.report.newest();
    if (loop_ && show_.figures().steps > 0 && gain_.see(Seconds(show_.figures().fluid_period_s)))
        give_orders();
    tell_of_flights();
    if (const auto news = gain_.news()) fmt::print(stderr, "run: {}\n", *news);
    if (const auto cause = orders_.cause_gone(now, loop_report_)) {
        if (*cause == GateReason::NotFinite) show_.reset();
        orders_.release_latch();
    }
    if (options_.seconds)
        progress_.show(Seconds(now).count(), *options_.seconds,
                       fmt::format("{} fluid steps", show_.figures().steps));
    if (status_file_.empty() || (now < status_due_ && !force)) return;
    status_due_ = now + 1s;
    write_status(status_file_, {scene_.title,
                                graphics_->gpu.capabilities().renderer,
                                graphics_->display->describe(),
                                device_name_,
                                Seconds(now).count(),
                                show_.figures(),
                                show_.guards(),
                                loop_report_,
                                cost(),
                                {gain_.gain(), scene_.haptics.gain, gain_.changes()},
                                flight_keeper_ ? flight_keeper_->kept() : 0});
}

/// Both loops on their own threads and the machine's clock, as a visitor meets them.
void Run::real() {
    RealClock clock;
    std::atomic<bool> stop_loop{false};
    RealtimeGrant grant;
    std::thread haptic_thread;
    // Whatever happens below, the loop ends by sending zero.
    struct EndLoop {
        std::atomic<bool>& stop;
        std::thread& thread;
        ~EndLoop() {
            stop = true;
            if (thread.joinable()) thread.join();
        }
    };
    std::optional<EndLoop> end_loop(std::in_place, stop_loop, haptic_thread);
    if (loop_)
        haptic_thread = std::thread([&] {
            grant = grant_realtime(MemoryLock::No);
            loop_->run(clock, stop_loop);
        });
    const Instant period = std::chrono::duration_cast<Instant>(Seconds(scene_.solver.dt_s));
    const Instant frame_period = std::chrono::duration_cast<Instant>(Seconds(1.0 / options_.frames_per_s));
    Instant last = clock.now(), now = last;
    while (!asked_to_stop() && now < end()) {
        clock.sleep_until(last + period);
        now = clock.now();
        go_on(now, now - last);
        last = now;
        show_.publish(false);
        if (recorder_ && now >= frame_due_) {
            const Seconds took = beside_the_fluid([&] { record_frame(now); });
            frame_due_ =
                now + std::max(frame_period, std::chrono::duration_cast<Instant>(took / kRenderShare));
        }
        show_.publish(false);
        drain_trace();
        report(now);
    }
    end_loop.reset();
    if (device_) device_name_ = device_->describe();
    drain_trace();
    now = clock.now();  // that of the last tick
    clock_s_ = wall_s_ = Seconds(now).count();
    report(now, true);
    if (loop_ && !grant.fifo)
        fmt::print(
            stderr,
            "the haptic thread had no real-time priority ({}): ticks were late when the machine was busy; a "
            "service gets it by LimitRTPRIO=50 in its unit\n",
            std::strerror(grant.fifo_error));
}

/// Both loops on one virtual clock and one thread: the same input gives the same run, bit for bit. The
/// fluid's answer reaches the hand one fluid period after its question, as on a GPU that works on it
/// meanwhile.
void Run::stepped() {
    SteppedClock clock;
    const RealClock wall;
    const Instant period = std::chrono::duration_cast<Instant>(Seconds(scene_.solver.dt_s));
    const Instant frame_period = std::chrono::duration_cast<Instant>(Seconds(1.0 / options_.frames_per_s));
    Instant fluid_due = period;
    const Instant stop = options_.seconds ? end() : Instant::max() - period;
    for (Instant t{0}; !asked_to_stop() && t < stop; t += kTick) {
        clock.sleep_until(t);
        if (loop_) loop_->tick(clock.now());
        if (t + kTick < fluid_due) continue;
        show_.publish(show_.figures().steps > 0);
        go_on(fluid_due, Seconds(period));
        if (recorder_ && fluid_due >= frame_due_) {
            record_frame(fluid_due);
            frame_due_ += frame_period;
        }
        fluid_due += period;
        drain_trace();
        report(t);
    }
    if (device_) device_name_ = device_->describe();
    drain_trace();
    show_.publish(true);
    clock_s_ = Seconds(clock.now()).count();
    wall_s_ = Seconds(wall.now()).count();
    report(clock.now(), true);
}

void Run::summarise() const {
    const ShowFigures& f = show_.figures();
    const auto print_stages = [&] {
        std::string text;
        for (const std::string& stage : stopwatch_.stages())
            text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", stage,
                                median(stopwatch_.of(stage).wall_ms));
        return text;
    };
    const gles::FluidSetup& fluid = show_.fluid().setup();
    fmt::print("scene       {} ({}x{}x{} cells of {:.2f} mm)\n", scene_.title, fluid.cells.x, fluid.cells.y,
               fluid.cells.z, fluid.cell_m * 1e3);
    fmt::print("renderer    {}, {}\n", graphics_->gpu.capabilities().renderer,
               graphics_->display->describe());
    fmt::print("hand        {}\n", device_name_);
    fmt::print("fluid       {} steps in {:.1f} s of {} clock: {:.1f} steps/s\n", f.steps, clock_s_,
               options_.clock == ClockChoice::Real ? "real" : "stepped",
               static_cast<double>(f.steps) / wall_s_);
    fmt::print("ms a stage  {} (wall, median of one step in {})\n", print_stages(), kMeasureEvery);
    fmt::print("divergence  {:.3g} 1/s before the projection, {:.3g} 1/s after it ({:.0f}-fold)\n",
               f.divergence_before_1_s, f.divergence_after_1_s,
               f.divergence_after_1_s > 0.0 ? f.divergence_before_1_s / f.divergence_after_1_s : 0.0);
    fmt::print("force       {:.3g} to {:.3g} N from the fluid after gain, at most {:.3g} N sent\n",
               f.least_force_n, f.most_force_n, sent_most_n_);
    fmt::print("haptic loop {} ticks in {:.1f} s: {:.0f} Hz; {} late, {} left out, worst {:.2f} ms\n",
               loop_report_.ticks, clock_s_,
               clock_s_ > 0.0 ? static_cast<double>(loop_report_.ticks) / clock_s_ : 0.0, loop_report_.late,
               loop_report_.missed, Seconds(loop_report_.worst_late).count() * 1e3);
    fmt::print("gate        {}; clamped {}, slewed {}, not finite {}\n", to_string(loop_report_.reason),
               loop_report_.gate.clamped, loop_report_.gate.slewed, loop_report_.gate.non_finite);
    if (recorder_)
        fmt::print("recorded    {} pictures, force.csv{} in {}\n", recorder_->frames(),
                   recorder_->plotted() ? " and motion.png" : "", recorder_->folder().string());
    else
        fmt::print("recorded    nothing (--record DIR keeps pictures and forces)\n");
}

}  // namespace

int run(const RunOptions& options) {
    stop_on_signals();
    const Exhibit exhibit = load_exhibit().exhibit;
    const Scene scene = load_scene(scene_name(options, exhibit), options.set).scene;
    require_possible(options, exhibit, scene);
    RunDevice device = make_device(options, exhibit);
    if (!options.record.empty()) prepare_folder("--record", options.record);
    if (!options.run_dir.empty()) prepare_folder("--run-dir", options.run_dir);
    if (!options.state_dir.empty()) prepare_folder("--state-dir", options.state_dir);
    Run run(options, exhibit, scene, std::move(device), open_headless());
    run.warm_up();
    if (options.clock == ClockChoice::Real)
        run.real();
    else
        run.stepped();
    run.finish();
    run.summarise();
    return run.recording_failed() ? 1 : 0;
}

}  // namespace eddy
