#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "config/scene.h"
#include "firmware/destination.h"
#include "firmware/exhibit/caption.h"
#include "firmware/exhibit/hand_side.h"
#include "firmware/exhibit/playbill.h"
#include "firmware/graphics.h"
#include "firmware/progress.h"
#include "firmware/recorder.h"
#include "firmware/status.h"
#include "firmware/text_file.h"
#include "firmware/verbs/run_device.h"
#include "firmware/verbs/run_options.h"
#include "firmware/verbs/stop.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

constexpr Seconds kSlowWarmUp{2.0};  // worth a line
/// Recording pictures may take this share of the time; the fluid has the rest.
constexpr double kRenderShare = 0.4;

Instant instant(Seconds s) {
    return std::chrono::duration_cast<Instant>(s);
}

void log(const std::string& line) {
    fmt::print(stderr, "run: {}\n", line);
}

HapticLoopSettings loop_settings(const Exhibit& exhibit, const Scene& scene) {
    HapticLoopSettings settings;
    settings.law = exhibit.force == ForceChoice::Filter ? ForceLaw::Filter : ForceLaw::Model;
    settings.gate.max_force_n = std::min(scene.haptics.max_force_n, exhibit.max_force_n);
    return settings;
}

/// An option's folder, or that of the exhibit.
std::filesystem::path folder_of(const std::string& option, const std::filesystem::path& exhibits) {
    return option.empty() ? exhibits : std::filesystem::path(option);
}

/// Where the seconds before a fault go. Where the exhibit keeps nothing else, it keeps no flights either.
std::filesystem::path flights_folder(const std::filesystem::path& state_dir) {
    return is_folder(state_dir) ? state_dir / "flights" : std::filesystem::path();
}

/// Everything one run holds, wired together.
class Run {
  public:
    Run(const RunOptions& options, const Exhibit& exhibit, const Scene& scene, RunDevice device,
        std::unique_ptr<Graphics> graphics)
        : options_(options),
          hand_(std::move(device.device), std::move(device.name), loop_settings(exhibit, scene),
                flights_folder(folder_of(options.state_dir, exhibit.state_dir))),
          graphics_(std::move(graphics)),
          playbill_(graphics_->gpu, hand_) {
        playbill_.announce(scene,
                           {.quality = quality_setup(options, exhibit, scene),
                            .has_picture = !options.record.empty(),
                            .has_hand = hand_.has_device(),
                            .shows_cost = options.overlay.value_or(exhibit.overlay) == OverlayChoice::Cost});
        if (!options.record.empty()) recorder_.emplace(options.record);
        // status.json goes where it is asked for; by default to the run folder of the service, if there is
        // one.
        const std::filesystem::path folder = folder_of(options.run_dir, exhibit.run_dir);
        if (is_folder(folder)) status_file_ = folder / "status.json";
    }

    /// Draws everything once, before the clock starts.
    void warm_up();
    void real();
    void stepped();
    /// Completes the recording.
    void finish();
    bool recording_failed() const { return recording_failed_; }
    /// Ten lines on standard output.
    void summarise() const;

  private:
    Act& act() { return playbill_.act(); }
    const Act& act() const { return playbill_.act(); }
    Instant end() const { return options_.seconds ? instant(Seconds(*options_.seconds)) : Instant::max(); }
    Instant period() const { return instant(Seconds(act().scene().solver.dt_s)); }
    Instant frame_period() const { return instant(Seconds(1.0 / options_.frames_per_s)); }
    void record_frame(Instant now);
    void follow_hand();
    void tell();
    void report(Instant now, bool force = false);

    RunOptions options_;
    HandSide hand_;
    std::unique_ptr<Graphics> graphics_;
    Playbill playbill_;
    std::optional<Recorder> recorder_;
    std::filesystem::path status_file_;
    Instant status_due_{0}, frame_due_{0};
    bool hand_seen_ = false;
    bool recording_failed_ = false;
    double clock_s_ = 0.0, wall_s_ = 0.0;
    Progress progress_{"run"};
};

void Run::warm_up() {
    std::optional<Playbill::News> news;
    while (!news) news = playbill_.work();
    if (!news->began) throw gles::GlError(news->failed);
    if (news->prepared > kSlowWarmUp)
        log(fmt::format("the driver took {:.1f} s to prepare its shaders", news->prepared.count()));
}

void Run::record_frame(Instant now) {
    const LoopReport& hand = hand_.report();
    hand_seen_ = hand_seen_ || hand.device == HapticState::Ready;
    const gles::Renderer& picture =
        act().draw(now, caption({hand_.has_device(), hand.device, hand.reason, hand_seen_, false}));
    try {
        recorder_->add(picture, act().scene().render.width_px, act().scene().render.height_px);
    } catch (const std::runtime_error& e) {
        // A full disk must not stop the show.
        fmt::print(stderr, "recording stopped: {}\n", e.what());
        recorder_.reset();
        recording_failed_ = true;
    }
}

void Run::follow_hand() {
    hand_.follow([this](std::span<const TickRecord> ticks) {
        if (recorder_) recorder_->add(ticks);
    });
}

void Run::tell() {
    if (const auto news = hand_.flight_news()) log(*news);
    for (const std::string& line : act().news()) log(line);
}

void Run::report(Instant now, bool force) {
    act().adjust_gain();
    tell();
    if (const auto cause = hand_.orders().cause_gone(now, hand_.report())) {
        if (*cause == GateReason::NotFinite) act().reset();
        hand_.orders().release_latch();
    }
    const ShowFigures& figures = act().show().figures();
    if (options_.seconds)
        progress_.show(Seconds(now).count(), *options_.seconds, fmt::format("{} fluid steps", figures.steps));
    if (status_file_.empty() || (now < status_due_ && !force)) return;
    status_due_ = now + 1s;
    const GainWatch& gain = act().gain();
    write_status(status_file_, {act().scene().title,
                                graphics_->gpu.capabilities().renderer,
                                graphics_->display->describe(),
                                hand_.name(),
                                Seconds(now).count(),
                                figures,
                                act().show().guards(),
                                hand_.report(),
                                act().cost(),
                                {gain.gain(), act().scene().haptics.gain, gain.changes()},
                                hand_.flights_kept()});
}

/// Both loops on their own threads and the machine's clock, as a visitor meets them.
void Run::real() {
    RealClock clock;
    hand_.start(clock);
    Instant last = clock.now(), now = last;
    while (!asked_to_stop() && now < end()) {
        clock.sleep_until(last + period());
        now = clock.now();
        act().go_on(now, now - last);
        last = now;
        act().publish(false);
        if (recorder_ && now >= frame_due_) {
            const Seconds took = act().beside_the_fluid([&] { record_frame(now); });
            frame_due_ = now + std::max(frame_period(), instant(took / kRenderShare));
        }
        act().publish(false);
        follow_hand();
        report(now);
    }
    hand_.end();
    follow_hand();
    now = clock.now();  // that of the last tick
    clock_s_ = wall_s_ = Seconds(now).count();
    report(now, true);
    if (const auto complaint = hand_.complaint()) fmt::print(stderr, "{}\n", *complaint);
}

/// Both loops on one virtual clock and one thread: the same input gives the same run, bit for bit. The
/// fluid's answer reaches the hand one fluid period after its question, as on a GPU that works on it
/// meanwhile.
void Run::stepped() {
    SteppedClock clock;
    const RealClock wall;
    Instant fluid_due = period();
    const Instant stop = options_.seconds ? end() : Instant::max() - period();
    for (Instant t{0}; !asked_to_stop() && t < stop; t += kTick) {
        clock.sleep_until(t);
        hand_.tick(clock.now());
        if (t + kTick < fluid_due) continue;
        act().publish(act().show().figures().steps > 0);
        act().go_on(fluid_due, Seconds(period()));
        if (recorder_ && fluid_due >= frame_due_) {
            record_frame(fluid_due);
            frame_due_ += frame_period();
        }
        fluid_due += period();
        follow_hand();
        report(t);
    }
    hand_.end();
    follow_hand();
    act().publish(true);
    clock_s_ = Seconds(clock.now()).count();
    wall_s_ = Seconds(wall.now()).count();
    report(clock.now(), true);
}

void Run::finish() {
    progress_.finish();
    if (recorder_) recorder_->finish();
    hand_.finish_flights();
    tell();
}

void Run::summarise() const {
    const ShowFigures& f = act().show().figures();
    const LoopReport& loop = hand_.report();
    const auto print_stages = [&] {
        std::string text;
        for (const std::string& stage : act().stopwatch().stages())
            text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", stage,
                                median(act().stopwatch().of(stage).wall_ms));
        return text;
    };
    const gles::FluidSetup& fluid = act().show().fluid().setup();
    fmt::print("scene       {} ({}x{}x{} cells of {:.2f} mm)\n", act().scene().title, fluid.cells.x,
               fluid.cells.y, fluid.cells.z, fluid.cell_m * 1e3);
    fmt::print("renderer    {}, {}\n", graphics_->gpu.capabilities().renderer,
               graphics_->display->describe());
    fmt::print("hand        {}\n", hand_.name());
    fmt::print("fluid       {} steps in {:.1f} s of {} clock: {:.1f} steps/s\n", f.steps, clock_s_,
               options_.clock == ClockChoice::Real ? "real" : "stepped",
               static_cast<double>(f.steps) / wall_s_);
    fmt::print("ms a stage  {} (wall, median of one step in {})\n", print_stages(), kMeasureEvery);
    fmt::print("divergence  {:.3g} 1/s before the projection, {:.3g} 1/s after it ({:.0f}-fold)\n",
               f.divergence_before_1_s, f.divergence_after_1_s,
               f.divergence_after_1_s > 0.0 ? f.divergence_before_1_s / f.divergence_after_1_s : 0.0);
    fmt::print("force       {:.3g} to {:.3g} N from the fluid after gain, at most {:.3g} N sent\n",
               f.least_force_n, f.most_force_n, hand_.sent_most_n());
    fmt::print("haptic loop {} ticks in {:.1f} s: {:.0f} Hz; {} late, {} left out, worst {:.2f} ms\n",
               loop.ticks, clock_s_, clock_s_ > 0.0 ? static_cast<double>(loop.ticks) / clock_s_ : 0.0,
               loop.late, loop.missed, Seconds(loop.worst_late).count() * 1e3);
    fmt::print("gate        {}; clamped {}, slewed {}, not finite {}\n", to_string(loop.reason),
               loop.gate.clamped, loop.gate.slewed, loop.gate.non_finite);
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
