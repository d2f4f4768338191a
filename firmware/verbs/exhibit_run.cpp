#include "firmware/verbs/exhibit_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "firmware/built_from.h"
#include "firmware/destination.h"
#include "firmware/exhibit/caption.h"
#include "firmware/run_summary.h"
#include "firmware/text_file.h"
#include "firmware/verbs/run_device.h"
#include "firmware/verbs/run_options.h"
#include "firmware/verbs/stop.h"
#include "gles/gpu.h"
#include "gles/render/window.h"
#include "hal/gpio/real_gpio.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

constexpr Seconds kSlowWarmUp{2.0};  // worth a line
/// Pictures may take this share of the time; the fluid has the rest.
constexpr double kRenderShare = 0.4;
constexpr Instant kBlink = 2s;
constexpr Instant kGuide = 60s;
/// Between two looks whether there is a graphics card by now.
constexpr Instant kCardEvery = 5s;
/// A USB bus that resets itself, as often as the kernel tries.
constexpr Instant kBusPatience = 30s;
/// Turns while nothing is shown.
constexpr Instant kClosedTurn = 50ms;
// Words for the next start and for systemd (eddy-poweroff.path), which read no settings: in the run folder as it is without them.
constexpr const char* kFactoryMarker = "factory.request";
constexpr const char* kPowerOff = "poweroff.request";
// A word for the next start of this program, none for that of the machine.
constexpr const char* kStopped = "stopped";
// What the screen says while there is nothing to play.
constexpr const char* kGettingReady = "Getting the fluid ready";
const std::vector<std::string> kMadeAnew{"One moment", "The picture is being made anew."};

std::filesystem::path state_folder(const RunOptions& options) {
    const std::filesystem::path folder =
        options.state_dir.empty() ? Exhibit{}.state_dir : std::filesystem::path(options.state_dir);
    return is_folder(folder) ? folder : std::filesystem::path();
}
std::filesystem::path run_folder(const RunOptions& options) {
    return options.run_dir.empty() ? Exhibit{}.run_dir : std::filesystem::path(options.run_dir);
}

/// Once.
bool take_marker(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::remove(file, error);
}

bool is_wired(const GpioConfig& gpio) {
    return !(gpio.button + gpio.stop + gpio.lamp_green + gpio.lamp_amber + gpio.lamp_red).empty();
}

}  // namespace

ExhibitRun::ExhibitRun(const RunOptions& options) : options_(options) {
    if (office_.has_manager()) outlive_console();
    prepare_folders(options);
    state_dir_ = state_folder(options);
}

int ExhibitRun::play() {
    look_back();
    open();
    if (!first_act()) return finish();

    show_began_ = clock_.now();
    office_.service().heartbeats().expect(Part::Render, show_began_);
    office_.service().heartbeats().expect(Part::Config, show_began_);
    if (panel_) office_.service().heartbeats().expect(Part::Gpio, show_began_);
    Instant last = show_began_;
    while (!done()) {
        clock_.sleep_until(last + (is_open_ ? period() : kClosedTurn));
        const Instant now = clock_.now();
        turn(now, now - last);
        last = now;
    }
    return finish();
}

bool ExhibitRun::ends() const {
    return asked_to_stop() || lost_ || again_ || shut_down_;
}

bool ExhibitRun::done() const {
    if (ends()) return true;
    return options_.seconds && clock_.now() - show_began_ >= instant(Seconds(*options_.seconds));
}

Instant ExhibitRun::period() const {
    return instant(Seconds(settings_->scene().solver.dt_s));
}

// ---------------------------------------------------------------------------------------------------- the start

void ExhibitRun::look_back() {
    if (state_dir_.empty()) return;
    office_.count_in(state_dir_);
    if (!office_.has_manager()) return;  // somebody who tries something out
    office_.say(Event::Started, fmt::format("eddy {} ({})", EDDY_VERSION, kBuiltFrom));
    office_.count(&Usage::starts);
    ledger_.emplace(state_dir_);
    verdict_ = ledger_->begin(std::time(nullptr), boot_id());
    if (!verdict_.written) office_.disk_trouble("that the program has started could not be written down");
    if (verdict_.before == EndBefore::Failed)
        office_.say(Event::EndedBadly, "the run before this one ended by itself");
    if (verdict_.before == EndBefore::PowerLost) {
        office_.count(&Usage::power_cuts);
        office_.say(Event::PowerCut, "the machine went away under the run before this one");
    }
    for (const std::string& line : CrashRecord::take_over(state_dir_)) office_.say(Event::Crashed, line);
    crash_.emplace(state_dir_, office_.journal().last_lines());
    if (verdict_.safe)
        office_.say(
            Event::SafeMode,
            verdict_.asked_for
                ? fmt::format("safe mode, for there is a file {}", (state_dir_ / "safe").string())
                : fmt::format("safe mode: {} restarts of the machine within an hour", verdict_.restarts));
    for (const Instant end = clock_.now() + std::chrono::seconds(verdict_.wait_s);
         clock_.now() < end && !asked_to_stop(); std::this_thread::sleep_for(100ms))
        office_.service().preparing(clock_.now(), "waiting before another start");
}

void ExhibitRun::open() {
    office_.service().preparing(clock_.now(), "reading the settings");
    const bool factory = take_marker(run_folder(options_) / kFactoryMarker);
    if (factory)
        office_.say(
            Event::ConfigFellBack,
            "the factory's settings, and no force until the next start, for the button was held at this one");
    settings_.emplace(options_,
                      ConfigIntake::Setup{.folder = options_.config,
                                          .state_dir = state_dir_,
                                          .run_dir = options_.run_dir,
                                          .orders = {options_.scene, options_.set, options_.presets},
                                          .factory_only = verdict_.safe || factory},
                      office_, clock_);
    const Exhibit& exhibit = settings_->exhibit();
    if (is_wired(exhibit.gpio)) {
        gpio_ = make_real_gpio();
        panel_.emplace(*gpio_, exhibit.gpio, clock_, run_folder(options_) / kStopped);
    }
    open_hand();
    if (!options_.record.empty()) prepare_folder("--record", options_.record);
    recording_.begin(options_.record);
    office_.service().preparing(clock_.now(), "opening the screen");
    // Where somebody starts the program again and again, a card that is not there yet is no reason to end.
    const bool waits = office_.has_manager() && exhibit.display == DisplayChoice::Kms;
    front_.emplace(
        open_display(waits ? DisplayChoice::Auto : exhibit.display, exhibit.screen, exhibit.state_dir),
        *hand_, is_folder(exhibit.state_dir) ? screen_memory(exhibit.state_dir) : std::filesystem::path(),
        exhibit.screen.max_pixels);
    prelude(kGettingReady);
    visitors_.emplace(Seconds(exhibit.unattended.idle_after_s));
    opening_.emplace(exhibit.hours);
    screenshot_.emplace(is_folder(exhibit.run_dir) ? exhibit.run_dir : std::filesystem::path());
}

void ExhibitRun::open_hand() {
    const Exhibit& exhibit = settings_->exhibit();
    RunDevice device = make_device(options_, exhibit, office_.has_manager());
    if (!device.trouble.empty())
        office_.say(Event::DeviceLost, device.trouble + "; a Falcon that was without power will not start");
    hand_.emplace(std::move(device.device), std::move(device.name), loop_settings(exhibit),
                  flights_folder(exhibit), panel_ ? &panel_->stop_input() : nullptr);
    hand_->orders().set_ceiling(exhibit.max_force_n);
    allow_force();
    if (panel_ && panel_->stop_was_held()) {
        hand_->orders().stay_stopped();
        office_.say(Event::Note, "the stop was pressed before this start: no force until somebody clicks");
    }
    if (crash_) crash_->watch(hand_->flights());
}

bool ExhibitRun::first_act() {
    const RealClock took;
    while (!ends()) {
        heed_screen(clock_.now());
        heed_settings();
        const auto news = front_->prepare([this] {
            settings_->heed();
            obey_settings();
            return prelude(kGettingReady) && !settings_->wants_another_act();
        });
        if (!news) continue;
        follow(*news);
        if (news->began && news->prepared > kSlowWarmUp)
            office_.say(Event::Note, fmt::format("the driver took {:.1f} s to prepare its shaders",
                                                 Seconds(took.now()).count()));
        if (news->began) return true;
    }
    return false;
}

/// Once it is known whether the stop is pressed.
void ExhibitRun::start_hand() {
    if (hand_runs_ || (panel_ && !panel_->settled())) return;
    hand_runs_ = true;
    hand_began_ = clock_.now();
    if (hand_->has_device()) office_.service().heartbeats().expect(Part::Haptic, hand_began_);
    hand_->start(clock_);
}

bool ExhibitRun::prelude(const std::string& what) {
    const Instant now = clock_.now();
    office_.service().preparing(now, what);
    const bool usable = front_->wait({"Eddy is starting", what + "."}, now);
    if (!first_words_ && front_->has_shown_words()) {
        first_words_ = true;
        office_.say_when(Event::FirstPicture,
                         "the first words are on " + front_->graphics().display->describe());
    }
    heed_panel(now);
    shine(now);
    start_hand();
    hand_->follow();
    return usable && !ends();
}

// ----------------------------------------------------------------------------------------------------- a turn

void ExhibitRun::turn(Instant now, Seconds since_last) {
    front_->gpu().on_pause([this](gles::Next next) {
        alive();
        if (next == gles::Next::Compiling) office_.service().long_work_begins();
    });
    if (!heed_screen(now)) return;
    heed_cards(now);
    const bool plays = front_->plays();
    if (plays && is_open_) front_->act().go_on(now, since_last);
    if (plays && !is_open_) front_->act().watch_hand(now);
    if (plays) front_->act().publish(false);
    draw(now);
    if (plays) front_->act().publish(false);
    hand_->follow([this](std::span<const TickRecord> ticks) { recording_.add(ticks); });
    start_hand();
    heed_panel(now);
    heed_hours(now);
    heed_visitors(now);
    heed_settings();
    prepare_next();
    heed_hand(now);
    get_ready(now);
    shine(now);
    report(now);
    office_.service().long_work_ends(clock_.now());
}

bool ExhibitRun::heed_screen(Instant now) {
    const DisplayState screen = front_->poll(now);
    lost_ = screen == DisplayState::Lost;
    again_ |= screen == DisplayState::Moved;
    return !lost_ && !again_;
}

/// Where somebody starts the program again.
void ExhibitRun::heed_cards(Instant now) {
    if (!front_->graphics().lacks_card || !office_.has_manager() || now < card_due_) return;
    card_due_ = now + kCardEvery;
    if (!card_has_come()) return;
    office_.say(Event::ScreenFound, "a graphics card has come up: the program starts again, with its screen");
    again_ = true;
}

void ExhibitRun::draw(Instant now) {
    const bool on_screen = is_open_ && front_->wants_picture();
    const bool asked = screenshot_->wanted(now);
    if (!is_open_ || !(front_->has_screen() || recording_.on())) office_.frame_times().interrupted();
    if (!asked && (now < frame_due_ || !(on_screen || recording_.on()))) return;

    const bool words = !front_->plays() || (guide_until_ && now < *guide_until_);
    const auto show = [&]() -> const gles::Texture& {
        if (words && front_->plays()) return front_->show_words(office_.guide_page(view()), now);
        if (words) return front_->show_words(kMadeAnew, now);
        return front_->show_act(now, caption_of(*hand_, presence_ == Presence::Leaving));
    };
    const auto work = [&] {
        const gles::Texture& picture = show();
        if (recording_.on() && now >= frame_due_) recording_.add(front_->gpu(), picture);
        if (asked)
            office_.say(Event::Screenshot, screenshot_->give(picture.size().x, picture.size().y,
                                                             gles::rgb_from_top(front_->gpu(), picture)));
    };
    const RealClock clock;
    if (front_->plays())
        front_->act().beside_the_fluid(work);
    else
        work();
    picture_shown_ |= on_screen && !words;
    if (on_screen || recording_.on()) office_.frame_times().shown(now);
    const Instant pause = instant(Seconds(clock.now()) * ((1.0 - kRenderShare) / kRenderShare));
    frame_due_ = recording_.on() ? now + std::max(instant(Seconds(1.0 / options_.frames_per_s)), pause)
                                 : clock_.now() + pause;
}

void ExhibitRun::get_ready(Instant now) {
    if (first_frame_ || !is_ready({.shown = picture_shown_,
                                   .has_screen = front_->has_screen(),
                                   .open = is_open_,
                                   .played = now - show_began_}))
        return;
    first_frame_ = true;
    office_.service().first_frame(now);
    office_.say_when(Event::Ready, fmt::format("{} on {}", settings_->scene().title,
                                               front_->graphics().display->describe()));
}

void ExhibitRun::heed_panel(Instant now) {
    if (!panel_) return;
    const PanelNews news = panel_->news();
    if (news.force_back) hand_->orders().restart();
    if (news.resets > 0) {
        guide_until_.reset();
        if (front_->plays()) begin_anew("somebody pressed the button");
    }
    if (news.guide) guide_until_ = now + kGuide;
    if (news.trouble != trouble_)
        office_.say(Event::Note, news.trouble.empty() ? "all lines are back" : news.trouble);
    trouble_ = news.trouble;
    if (news.button_stuck && !button_stuck_)
        office_.say(Event::Note, "the button has been down for a minute: it is ignored until it is let go");
    button_stuck_ = news.button_stuck;
    const auto leave_word = [&](const char* name) {
        try {
            replace_text_file(run_folder(options_) / name, "");
        } catch (const std::runtime_error& e) {
            office_.disk_trouble(e.what());
        }
    };
    if (news.shutdown) {
        office_.say(Event::Stopping, "the button was held for ten seconds: the machine is switched off");
        leave_word(kPowerOff);
        panel_->show(LampCode::ShuttingDown);
        shut_down_ = true;
    }
    if (news.factory) {
        leave_word(kFactoryMarker);
        again_ = true;
    }
}

void ExhibitRun::heed_hand(Instant now) {
    if (!front_->plays()) return;
    front_->act().adjust_gain(hand_->report());
    front_->act().release_latch(now, hand_->report());
}

void ExhibitRun::heed_visitors(Instant now) {
    if (!hand_->has_device() || !front_->plays()) return;
    if (!is_open_ && presence_ == Presence::Nobody) {
        visitors_->closed(now);
        return;
    }
    const Visitors::News news = visitors_->see(now, front_->act().watch().untouched());
    presence_ = visitors_->presence();
    if (news.came) {
        office_.say(Event::VisitBegan, "somebody is here");
        office_.count(&Usage::visits);
    }
    if (!news.gone) return;
    office_.say(Event::VisitEnded, fmt::format("gone after {:.0f} s", news.dwell.count()));
    office_.count(&Usage::dwell_s, news.dwell.count());
    begin_anew("nobody is here");
}

void ExhibitRun::heed_hours(Instant now) {
    if (now < look_due_) return;
    look_due_ = now + 1s;
    const Opening::State& state = opening_->look(std::time(nullptr), clock_sync_.look(ask_kernel()));
    if (opening_->doubts(now)) office_.say(Event::ClockUnsure, describe(state));
    if (state.open == is_open_) return;
    is_open_ = state.open;
    office_.say(is_open_ ? Event::Opened : Event::Closed, describe(state));
    allow_force();
    front_->set_awake(is_open_);
    if (is_open_) begin_anew("it opens");
}

/// The factory's settings name no stop input, and the last good ones perhaps another: where they stand in for the owner's there
/// may be one that nobody looks at.
void ExhibitRun::allow_force() {
    const ConfigReport& settings = settings_->report();
    hand_->orders().allow(is_open_ && !verdict_.safe && !settings.stands_in && !settings.stop_unread);
}

void ExhibitRun::begin_anew(const std::string& why) {
    if (front_->plays()) front_->act().reset();
    office_.count(&Usage::resets);
    office_.say(Event::Reset, "the scene begins anew: " + why);
}

// -------------------------------------------------------------------------------------------------- the settings

void ExhibitRun::heed_settings() {
    settings_->heed();
    obey_settings();
    if (!settings_->wants_another_act()) return;
    const auto [exhibit, scene] = settings_->announce();
    front_->announce(scene, act_setup(options_, exhibit, scene, recording_.on() || front_->has_screen(),
                                      hand_->has_device()));
}

void ExhibitRun::obey_settings() {
    const RunSettings::News news = settings_->news();
    if (news.apply) apply_live();
    if (news.taken) blink(LampCode::Accepted);
    if (news.refused) blink(LampCode::Rejected);
}

void ExhibitRun::prepare_next() {
    if (!front_->preparing()) return;
    office_.service().long_work_begins();
    std::optional<Playbill::News> news;
    if (front_->plays()) {
        // The last piece puts another act in the place of the one that plays: whichever it is then has lost that time.
        front_->gpu().finish();
        const RealClock clock;
        news = front_->prepare([this] {
            alive();
            return !asked_to_stop();
        });
        front_->act().was_elsewhere(clock.now());
    } else {
        news = front_->prepare([this] { return front_->wait(kMadeAnew, clock_.now()) && !asked_to_stop(); });
    }
    if (news) follow(*news);
}

void ExhibitRun::follow(const Playbill::News& news) {
    if (news.began)
        settings_->began(news.prepared);
    else
        settings_->failed(news.failed);
    obey_settings();
}

void ExhibitRun::apply_live() {
    const Exhibit& exhibit = settings_->exhibit();
    hand_->orders().set_ceiling(exhibit.max_force_n);
    allow_force();
    if (front_->plays()) front_->act().show_cost(exhibit.overlay == OverlayChoice::Cost);
    visitors_->set_idle_after(Seconds(exhibit.unattended.idle_after_s));
    opening_.emplace(exhibit.hours);
    look_due_ = Instant(0);
}

// ------------------------------------------------------------------------------------------- what others are told

ExhibitFacts ExhibitRun::facts() const {
    const LoopReport& loop = hand_->report();
    return {
        .first_frame = first_frame_,
        .open = is_open_,
        .safe = verdict_.safe,
        .has_device = hand_->has_device(),
        .device = loop.device,
        .force = loop.reason,
        .presence = presence_,
        .has_screen = front_->has_screen() || !wants_screen(),
        .button_stuck = button_stuck_ || !trouble_.empty() || hanging_ == Part::Gpio,
        .fell_back = settings_->report().source == ConfigSource::LastGood || settings_->report().stands_in,
        .files_wait = hanging_ == Part::Config};
}

/// A service has its screen to itself; elsewhere `auto` finds none where there is a desktop.
bool ExhibitRun::wants_screen() const {
    const DisplayChoice display = settings_->exhibit().display;
    return display == DisplayChoice::Kms || (display == DisplayChoice::Auto && office_.has_manager());
}

void ExhibitRun::blink(LampCode code) {
    blink_ = code;
    blink_until_ = clock_.now() + kBlink;
}

void ExhibitRun::shine(Instant now) {
    if (!panel_) return;
    LampCode code = lamp_code(facts());
    if (guide_until_ && now < *guide_until_) code = LampCode::Guide;
    if (blink_until_ && now < *blink_until_) code = blink_;
    if (shut_down_) code = LampCode::ShuttingDown;
    panel_->show(code);
    // The ring speaks for lamps that hang.
    hand_->exchange().light.publish(hanging_ == Part::Gpio ? ring(code, now) : panel_->handle_light());
}

Office::View ExhibitRun::view() const {
    return {.exhibit = settings_->exhibit(),
            .scene = settings_->scene(),
            .settings = settings_->report(),
            .settings_good = settings_->good(),
            .settings_taken_at_s = settings_->taken_at_s(),
            .front = *front_,
            .hand = *hand_,
            .opening = *opening_,
            .clock_sync = clock_sync_,
            .facts = facts(),
            .trouble = trouble_};
}

void ExhibitRun::report(Instant now, bool finally) {
    office_.tell_news(*front_, *hand_);
    alive();
    if (!office_.report(now, view(), finally)) return;
    if (options_.seconds && front_->plays())
        progress_.show(Seconds(now - show_began_).count(), *options_.seconds,
                       fmt::format("{} fluid steps", front_->act().show().figures().steps));
}

/// The watchdog is fed if every part has got on. A turn gets on in the pauses of its GPU work, too: tuning, and other
/// qualities of the fluid, may take longer to compile on a slow machine than the watchdog waits.
void ExhibitRun::alive() {
    const Instant now = clock_.now();  // not the turn's: it may have been a long one
    ++beats_;
    Heartbeats& beats = office_.service().heartbeats();
    beats.see(Part::Render, beats_, now);
    if (!settings_->is_held_up(now)) beats.see(Part::Config, beats_, now);
    // A loop whose device comes or goes may have to wait for the kernel; there is no force then.
    const LoopReport& loop = hand_->exchange().report.newest();
    beats.give(Part::Haptic, loop.device == HapticState::Ready ? Heartbeats::kPatience : kBusPatience);
    beats.see(Part::Haptic, loop.ticks, now);
    if (panel_) beats.see(Part::Gpio, panel_->beats(), now);
    if (const auto part = beats.hanging(now); part != hanging_) tell_of_hang(part);
    office_.service().go_on(now);
}

void ExhibitRun::tell_of_hang(std::optional<Part> part) {
    const std::optional<Part> was = std::exchange(hanging_, part);
    if (part == Part::Gpio) {
        office_.say(
            Event::Hangs,
            "button, stop input and lamps do not answer; a stop input counts as pressed until they do and "
            "somebody clicks: unplug their USB bridge and plug it in again");
        office_.count(&Usage::faults);
    } else if (part == Part::Config) {
        office_.say(
            Event::Hangs,
            "the files of the settings have been read or kept for a minute: new ones have to wait; the "
            "disk, or the network that they lie on, may be failing");
        office_.count(&Usage::faults);
    } else if (part) {
        office_.say(Event::Hangs, fmt::format("a part of the program does not get on: {}", to_word(*part)));
    } else if (was == Part::Gpio) {
        office_.say(Event::Note, "button, stop input and lamps answer again");
    } else if (was == Part::Config) {
        office_.say(Event::Note, "the files of the settings are read and kept again");
    }
}

int ExhibitRun::finish() {
    office_.service().stopping();
    if (hand_) hand_->end();  // with zero force, before anything else is said
    if (hand_) hand_->follow([this](std::span<const TickRecord> ticks) { recording_.add(ticks); });
    if (settings_) settings_->stopped();
    // A screen that stays lost is a failure: five of them start the machine anew, which cures most cards.
    if (ledger_ && again_) ledger_->end_for_restart();
    if (ledger_ && !again_ && !lost_) ledger_->end_well();
    const Instant now = clock_.now();
    progress_.finish();
    recording_.finish();
    if (front_ && front_->plays()) {
        hand_->finish_flights();
        report(now, true);
        const double show_s = Seconds(now - show_began_).count();
        print_summary({"real", show_s, Seconds(now - hand_began_).count(), show_s}, front_->act(),
                      front_->graphics(), *hand_, recording_.recorder());
    }
    office_.close();
    if (lost_ || again_) return kExitForRestart;
    return recording_.failed() ? 1 : 0;
}

}  // namespace eddy
