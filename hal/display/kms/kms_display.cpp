#include "hal/display/kms/kms_display.h"

#include <drm_fourcc.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace eddy::kms {
namespace {

using namespace std::chrono_literals;

constexpr Instant kMasterRetry = 1s;
constexpr Instant kPlugsSettle = 500ms;  // a plug going in makes several changes
constexpr Instant kPlugsPoll = 10s;      // changes that nobody told of
constexpr Instant kWakeRetry = 30s;
constexpr Instant kWakeReport = 10min;
constexpr Instant kSleepRetry = 10s;
/// More than a frame of the slowest screens.
constexpr auto kLastFlip = 50ms;

std::string reason(int error) {
    return std::strerror(error);
}

}  // namespace

bool has_card(Machine& machine) {
    for (const std::string& path : machine.cards()) {
        const Machine::Opened opened = machine.open(path);
        if (!opened.card) continue;
        opened.card->enable_atomic();  // plugs show what it needs only after this
        if (!look_for_monitors(*opened.card, false).empty()) return true;
    }
    return false;
}

// ---------------------------------------------------------------------------------------------- start-up

KmsDisplay::KmsDisplay(std::unique_ptr<Machine> machine, Wish wish)
    : machine_(std::move(machine)), wish_(std::move(wish)) {
    open_card();
    windows_ = machine_->make_windows(*card_);
    if (!windows_)
        throw KmsError(
            fmt::format("{}: GBM cannot be used with it; is its driver installed (libgbm1, "
                        "libgl1-mesa-dri)?",
                        path_));
    machine_->set_console_text(false);
    if (card_->is_master() || card_->take_master() == 0)
        attach(look_for_monitors(*card_, false));
    else
        lose_master();
}

Machine::Opened KmsDisplay::open(const std::string& path) {
    Machine::Opened opened = machine_->open(path);
    if (opened.card) opened.card->enable_atomic();  // plugs show what it needs only after this
    return opened;
}

void KmsDisplay::open_card() {
    const std::vector<std::string> paths = machine_->cards();
    if (paths.empty())
        throw KmsError(
            "no graphics card that could drive a screen: there is no /dev/dri/card*; is the card's driver "
            "loaded (lspci -k)?");
    std::string troubles;
    for (const std::string& path : paths) {
        Machine::Opened opened = open(path);
        if (!opened.card) {
            troubles += fmt::format("{}{}: {}", troubles.empty() ? "" : "; ", path, reason(opened.error));
            if (opened.error == EACCES)
                troubles += ": this user must be in the group that owns it (video), or root";
            continue;
        }
        const std::vector<Monitor> monitors = look_for_monitors(*opened.card, true);
        if (monitors.empty()) {
            troubles += fmt::format("{}{}: it has no plug for a screen", troubles.empty() ? "" : "; ", path);
            continue;
        }
        const bool has_it = choose_monitor(monitors, wish_).has_value();
        if (drawing_card_ && !has_it) continue;
        drawing_card_ = std::move(opened.card);
        path_ = path;
        if (has_it) break;
    }
    if (!drawing_card_) throw KmsError(troubles);
    card_ = drawing_card_.get();
}

void KmsDisplay::attach(std::vector<Monitor> monitors) {
    if (!found_) found_.emplace(*card_);

    // Connector.
    const auto chosen = choose_monitor(monitors, wish_);
    if (!chosen) {
        detach(no_monitor_problem(monitors));
        return;
    }
    monitor_ = std::move(monitors[chosen->index]);

    // CRTC and plane.
    std::string why;
    output_ = Output::find(*card_, *monitor_, why);
    if (!output_) {
        detach(why);
        return;
    }
    touched_.insert(output_->crtc());

    // Mode, and the kind of window: each that the card refuses is followed by the next, and when all are refused all are
    // tried again at the next look for monitors.
    attempts_ = attempts();
    attempt_ = 0;
    mode_is_set_ = false;
    problem_.clear();
    next_window();
}

std::vector<KmsDisplay::Attempt> KmsDisplay::attempts() const {
    std::vector<Attempt> result;
    const bool atomic = output_->can_be_atomic();
    const bool modifiers = !output_->modifiers(DRM_FORMAT_XRGB8888).empty();
    bool first = true;
    for (const ChosenMode& mode : choose_modes(*monitor_, wish_)) {
        const auto add = [&](std::uint32_t format, Layout layout, bool by_atomic) {
            if (!by_atomic || output_->takes(format)) result.push_back({mode, format, layout, by_atomic});
        };
        if (atomic) {
            if (first && modifiers) add(DRM_FORMAT_XRGB8888, Layout::Modifiers, true);
            add(DRM_FORMAT_XRGB8888, Layout::Own, true);
            if (first) add(DRM_FORMAT_XRGB8888, Layout::Linear, true);
            if (first) add(DRM_FORMAT_ARGB8888, Layout::Own, true);
        }
        add(DRM_FORMAT_XRGB8888, Layout::Own, false);
        if (first) add(DRM_FORMAT_XRGB8888, Layout::Linear, false);
        if (first) add(DRM_FORMAT_ARGB8888, Layout::Own, false);
        first = false;
    }
    return result;
}

void KmsDisplay::next_window() {
    retire_window();
    ++window_number_;
    for (; attempt_ < attempts_.size(); ++attempt_) {
        const Attempt& a = attempts_[attempt_];
        std::vector<std::uint64_t> modifiers;
        if (a.layout == Layout::Modifiers) modifiers = output_->modifiers(a.format);
        window_ = windows_->make(a.mode.mode.hdisplay, a.mode.mode.vdisplay, a.format, a.layout, modifiers);
        if (!window_) {
            ++counters_.refused;
            continue;
        }
        output_->use_atomic(a.atomic);
        return;
    }
    detach(
        fmt::format("{} refuses every mode and kind of picture for {}; kernel messages (dmesg) may say why, "
                    "and screen.mode "
                    "can ask for another mode",
                    path_, monitor_->plug));
}

// ------------------------------------------------------------------------------------------- what EGL needs

unsigned KmsDisplay::egl_platform() const {
    return windows_->egl_platform();
}
void* KmsDisplay::native_display() const {
    return windows_->native();
}
void* KmsDisplay::native_window() const {
    return window_ ? window_->native() : nullptr;
}

std::optional<SizePx> KmsDisplay::size_px() const {
    if (!window_) return std::nullopt;
    const drmModeModeInfo& mode = attempts_[attempt_].mode.mode;
    return SizePx{mode.hdisplay, mode.vdisplay};
}

void KmsDisplay::refuse_window() {
    if (!window_) return;
    ++counters_.refused;
    ++attempt_;
    next_window();
}

std::string KmsDisplay::describe() const {
    if (!monitor_ || !window_) return fmt::format("{}: {}", path_, to_string(state()));
    const ChosenMode& mode = attempts_[attempt_].mode;
    return fmt::format("{} of {} ({}), {} ({}), {}", monitor_->plug, path_,
                       monitor_->name.empty() ? "it gives no name" : monitor_->name, kms::describe(mode.mode),
                       mode.why, output_->atomic() ? "atomic commits" : "older calls");
}

// --------------------------------------------------------------------------------------------- each frame

DisplayState KmsDisplay::state() const {
    if (lost_) return moved_ ? DisplayState::Moved : DisplayState::Lost;
    if (!awake_) return DisplayState::Asleep;
    return window_ && master_ && !waking_ ? DisplayState::Showing : DisplayState::NoMonitor;
}

DisplayState KmsDisplay::poll(Instant now) {
    now_ = now;
    if (lost_) return state();
    watch_master();
    take_events();
    cure();
    watch_plugs();
    fall_asleep();
    wake_up();
    send_waiting();
    return state();
}

bool KmsDisplay::wants_frame() const {
    return !lost_ && awake_ && master_ && window_ && !waiting_ && (!waking_ || waking_->trying);
}

void KmsDisplay::present() {
    if (!window_) return;
    // Whoever presents this window has let go of those before it; what is still on the screen goes with the next flip.
    std::erase_if(old_windows_, [](const OldWindow& old) { return old.framebuffers.empty(); });
    Frame frame{window_.get(), window_->lock_front()};
    if (!frame) return;
    if (lost_ || !awake_ || !master_ || (waking_ && !waking_->trying)) {
        drop(frame);
        return;
    }
    if (waiting_) {
        drop(waiting_);
        ++counters_.replaced;
    }
    waiting_ = frame;
    send_waiting();
    if (waiting_ && !waiting_.window->has_free()) {  // GL must have one to draw into
        drop(waiting_);
        ++counters_.replaced;
    }
}

void KmsDisplay::send_waiting() {
    if (!waiting_ || flying_ || !awake_ || !master_ || lost_) return;
    if (const auto due = pacer_.next(); mode_is_set_ && due && card_->clock() < *due) return;
    send(std::exchange(waiting_, {}));
}

void KmsDisplay::send(Frame frame) {
    const drmModeModeInfo mode = attempts_[attempt_].mode.mode;
    const bool setting_mode = !mode_is_set_;
    std::uint32_t framebuffer = 0;
    int error = framebuffer_of(frame, framebuffer);
    if (error == 0) error = setting_mode ? output_->set_mode(mode, framebuffer) : output_->flip(framebuffer);
    if (error != 0) {
        refused(frame, error, setting_mode);
        return;
    }
    flying_ = frame;
    sent_ = card_->clock();
    watch_.expect(now_);
    if (!setting_mode) return;
    mode_is_set_ = true;
    ++counters_.modesets;
    pacer_ = Pacer(std::chrono::duration_cast<Instant>(Seconds(1.0 / refresh_hz(mode))));
}

void KmsDisplay::refused(Frame frame, int error, bool setting_mode) {
    if (error == EBUSY) {  // something else is on its way to this screen; the same again when there is time
        watch_.expect(now_);
        if (waiting_)
            drop(frame);
        else
            waiting_ = frame;
        return;
    }
    drop(frame);
    ++counters_.refused;
    if (error == EACCES || error == EPERM) {
        ++counters_.master_lost;
        lose_master();
    } else if (error == ENODEV) {
        reopen();
    } else if (setting_mode) {
        ++attempt_;
        next_window();
    } else {
        watch_.expect(now_);
        mode_is_set_ = false;
    }
}

void KmsDisplay::take_events() {
    for (const FlipEvent& event : card_->events()) {
        if (!flying_ || !output_ || (event.crtc != 0 && event.crtc != output_->crtc())) continue;
        ++counters_.flips;
        pacer_.flipped(sent_, event.time);
        if (pacer_.was_late()) ++counters_.late;
        drop(shown_);
        for (Frame& frame : stuck_) drop(frame);
        stuck_.clear();
        shown_ = std::exchange(flying_, {});
        // Nothing of other windows is on the screen any more.
        for (OldWindow& old : old_windows_)
            if (old.window.get() != shown_.window) remove_framebuffers(old);
        watch_.flipped(now_);
        waking_.reset();
        problem_.clear();
    }
}

// -------------------------------------------------------------------------------------------- what goes wrong

void KmsDisplay::cure() {
    const FlipWatch::Cure cure = watch_.due(now_);
    if (cure == FlipWatch::Cure::None) return;
    flying_is_stuck();
    if (!monitor_ || !awake_ || waking_) {  // going to sleep needs none; waking has its own time
        watch_.begin_again();
        if (waking_) waking_->trying = false;
        return;
    }
    switch (cure) {
        case FlipWatch::Cure::SetMode:
            ++counters_.recoveries;
            problem_ = fmt::format("no frame came onto {} for 3 s; setting its mode again", monitor_->plug);
            mode_is_set_ = false;
            break;
        case FlipWatch::Cure::Reopen:
            reopen();
            break;
        default:
            give_up(fmt::format("no frame comes onto the screen, though {} was opened again", path_));
    }
}

bool KmsDisplay::settle() {
    if (flying_) card_->wait(kLastFlip);
    take_events();
    return !flying_;
}

void KmsDisplay::flying_is_stuck() {
    if (flying_) stuck_.push_back(std::exchange(flying_, {}));
}

void KmsDisplay::reopen() {
    ++counters_.reopenings;
    detach(fmt::format("{} is opened again, for no frame came onto the screen", path_), Off::Leave);
    card_->drop_master();
    Machine::Opened opened = open(path_);
    if (!opened.card) {
        give_up(fmt::format("{} cannot be opened again: {}", path_, reason(opened.error)));
        return;
    }
    use(std::move(opened.card));
    if (!card_->is_master() && card_->take_master() != 0) {
        lose_master();
        return;
    }
    attach(look_for_monitors(*card_, true));
    if (monitor_) watch_.expect(now_);
}

void KmsDisplay::use(std::unique_ptr<Card> card) {
    for (OldWindow& old : old_windows_)
        if (old.card == reopened_.get()) old.framebuffers.clear();  // they go with it
    reopened_ = std::move(card);
    card_ = reopened_.get();
}

void KmsDisplay::give_up(const std::string& problem) {
    lost_ = true;
    problem_ = problem + "; only a restart of the program can help";
}

void KmsDisplay::lose_master() {
    master_ = false;
    master_try_ = now_ + kMasterRetry;
    mode_is_set_ = false;
    flying_is_stuck();
    drop(waiting_);
    watch_.forget();
    const std::string who = machine_->holders(path_);
    problem_ = fmt::format(
        "{} is driven by {}; end it (a desktop, a splash screen that stays, another eddy), tried again each "
        "second",
        path_, who.empty() ? "another program (eddy screen names it, as root)" : who);
}

void KmsDisplay::watch_master() {
    if (master_ || now_ < master_try_) return;
    master_try_ = now_ + kMasterRetry;
    if (!card_->is_master() && card_->take_master() != 0) {
        // Who never was master becomes it only by opening the card while nobody is.
        Machine::Opened opened = open(path_);
        if (!opened.card || (!opened.card->is_master() && opened.card->take_master() != 0)) return;
        detach("", Off::Leave);
        use(std::move(opened.card));
    }
    master_ = true;
    dark_ = false;
    problem_.clear();
    watch_.begin_again();
    mode_is_set_ = false;
    if (!monitor_) attach(look_for_monitors(*card_, true));
}

// ------------------------------------------------------------------------------------- monitors come and go

void KmsDisplay::watch_plugs() {
    if (machine_->plugs_changed()) plugs_settled_ = now_ + kPlugsSettle;
    if (!awake_ || !master_) return;  // many a television lets go of its plug while it sleeps
    if (plugs_settled_ && now_ >= *plugs_settled_) {
        plugs_settled_.reset();
        ++counters_.hot_plugs;
        look_due_ = look_probes_ = true;
    }
    if (now_ >= plugs_poll_) {
        plugs_poll_ = now_ + kPlugsPoll;
        look_due_ = true;
        // To ask the plugs takes its time, in which no frame is shown: while one is, what the kernel knows must do.
        look_probes_ = look_probes_ || !monitor_;
    }
    if (!look_due_ || flying_) return;
    if (waking_) {
        if (look_probes_) waking_->next_try = std::min(waking_->next_try, now_);
    } else {
        look_again(look_probes_);
    }
    look_due_ = look_probes_ = false;
}

void KmsDisplay::look_again(bool probe) {
    std::vector<Monitor> monitors = look_for_monitors(*card_, probe);
    if (!monitor_) {
        attach(std::move(monitors));
        if (!monitor_) look_at_other_cards();
        return;
    }
    const auto now = std::find_if(monitors.begin(), monitors.end(),
                                  [this](const Monitor& m) { return m.connector == monitor_->connector; });
    // The screen that shows stays, if it can.
    if (now == monitors.end() || !choose_monitor(std::span(&*now, 1), wish_)) {
        detach(no_monitor_problem(monitors));
        attach(std::move(monitors));
        if (!monitor_) look_at_other_cards();
        return;
    }
    if (same_monitor(*now, *monitor_) && !now->link_bad) return;
    const drmModeModeInfo before = attempts_[attempt_].mode.mode;
    monitor_ = *now;
    mode_is_set_ = false;
    if (same_mode(choose_modes(*monitor_, wish_).front().mode, before)) return;
    attempts_ = attempts();
    attempt_ = 0;
    next_window();
}

void KmsDisplay::look_at_other_cards() {
    for (const std::string& path : machine_->cards()) {
        if (path == path_) continue;
        const Machine::Opened other = open(path);
        if (!other.card || !choose_monitor(look_for_monitors(*other.card, true), wish_)) continue;
        // What GL has drawn lies in the memory of this card; the next process begins with that one.
        moved_ = true;
        give_up(fmt::format("the screen is on {} now, and no longer on {}", path, path_));
        return;
    }
}

void KmsDisplay::detach(const std::string& problem, Off off) {
    const bool answers = off == Off::Switch && settle();
    if (window_) ++window_number_;
    retire_window();
    if (answers) {
        if (output_ && master_) output_->off();
        for (OldWindow& old : old_windows_) remove_framebuffers(old);
    }
    drop(shown_);
    drop(flying_);
    for (Frame& frame : stuck_) drop(frame);
    stuck_.clear();
    monitor_.reset();
    output_.reset();
    attempts_.clear();
    mode_is_set_ = false;
    watch_.forget();
    problem_ = problem;
}

std::string KmsDisplay::no_monitor_problem(const std::vector<Monitor>& monitors) const {
    std::string plugs;
    bool known = wish_.connector.empty();
    for (const Monitor& m : monitors) {
        plugs += (plugs.empty() ? "" : ", ") + m.plug;
        known = known || is_named(m, wish_.connector);
    }
    if (!known)
        return fmt::format("screen.connector: {} has no {}; it has {}", path_, wish_.connector, plugs);
    return fmt::format("no screen is connected to {} ({}); check its cable and its power{}", path_,
                       wish_.connector.empty() ? plugs : wish_.connector,
                       wish_.connector.empty() ? ", or name a plug in screen.connector" : "");
}

// -------------------------------------------------------------------------------------------------- night

void KmsDisplay::set_awake(bool awake) {
    if (awake == awake_) return;
    awake_ = awake;
    sleep_again_.reset();
    if (!awake) {
        waking_.reset();
        return;
    }
    if (!dark_) return;  // it did not come to that
    dark_ = false;
    waking_ = Waking{now_, now_};
    waking_->needs_edid = monitor_ && !monitor_->id.empty();
}

void KmsDisplay::fall_asleep() {
    if (awake_ || flying_ || !master_) return;
    if (dark_ && (!sleep_again_ || now_ < *sleep_again_)) return;
    dark_ = true;
    const bool again = std::exchange(sleep_again_, std::nullopt).has_value();
    drop(waiting_);
    watch_.begin_again();
    mode_is_set_ = false;
    if (!output_) return;
    // Drivers without DPMS can do no more than end the mode; in the morning it is set as at a start.
    int error = output_->sleep();
    if (error) error = output_->off();
    if (error) {
        ++counters_.refused;
        sleep_again_ = now_ + kSleepRetry;
        problem_ = fmt::format("{} cannot be switched off: {}", monitor_->plug, reason(error));
    } else if (again) {
        problem_.clear();
    }
}

void KmsDisplay::wake_up() {
    if (!waking_ || flying_ || !master_ || now_ < waking_->next_try) return;
    if (waking_->tried) ++counters_.wake_retries;
    const bool late = now_ - waking_->since >= kWakeReport;
    std::vector<Monitor> monitors = look_for_monitors(*card_, true);
    const auto chosen = choose_monitor(monitors, wish_);
    // A screen that does not say who it is, though it did in the evening, is still starting.
    const bool there = chosen && (!waking_->needs_edid || late || !monitors[chosen->index].id.empty());
    if (waking_->tried || !there || !monitor_ || !same_monitor(monitors[chosen->index], *monitor_)) {
        detach("");
        if (there) attach(std::move(monitors));
    }
    waking_->trying = monitor_.has_value();
    waking_->tried = true;
    waking_->next_try = now_ + kWakeRetry;
    mode_is_set_ = false;
    if (late)
        problem_ =
            fmt::format("the screen has not woken up for {} min; check its power and its remote control",
                        std::chrono::duration_cast<std::chrono::minutes>(now_ - waking_->since).count());
    else if (!there)
        problem_ = "the screen is not awake yet";
}

// ------------------------------------------------------------------------------------------------ buffers

int KmsDisplay::framebuffer_of(const Frame& frame, std::uint32_t& id) {
    if (const auto known = framebuffers_.find(frame.buffer); known != framebuffers_.end()) {
        id = known->second;
        return 0;
    }
    if (const int error = card_->add_framebuffer(*frame.buffer, id)) return error;
    framebuffers_[frame.buffer] = id;
    return 0;
}

void KmsDisplay::drop(Frame& frame) {
    if (frame) frame.window->release(frame.buffer);
    frame = {};
}

void KmsDisplay::retire_window() {
    if (!window_) return;
    drop(waiting_);
    OldWindow old{std::move(window_), card_, {}};
    for (const auto& [buffer, id] : framebuffers_) old.framebuffers.push_back(id);
    framebuffers_.clear();
    const auto uses = [&old](const Frame& f) { return f.window == old.window.get(); };
    if (!uses(shown_) && !uses(flying_) && std::none_of(stuck_.begin(), stuck_.end(), uses))
        remove_framebuffers(old);
    old_windows_.push_back(std::move(old));
}

void KmsDisplay::remove_framebuffers(OldWindow& old) {
    for (const std::uint32_t id : old.framebuffers) old.card->remove_framebuffer(id);
    old.framebuffers.clear();
}

KmsDisplay::~KmsDisplay() {
    settle();
    if (found_ && master_) found_->put_back(*card_, touched_);
    retire_window();
    for (OldWindow& old : old_windows_) {
        remove_framebuffers(old);
        for (Frame* frame : {&shown_, &flying_})
            if (frame->window == old.window.get()) drop(*frame);
    }
    machine_->set_console_text(true);
}

}  // namespace eddy::kms
