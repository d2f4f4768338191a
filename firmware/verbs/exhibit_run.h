#pragma once
#include <optional>
#include <string>
#include <vector>

#include "firmware/exhibit/crash_record.h"
#include "firmware/exhibit/front.h"
#include "firmware/exhibit/hand_side.h"
#include "firmware/exhibit/office.h"
#include "firmware/exhibit/opening_hours.h"
#include "firmware/exhibit/panel.h"
#include "firmware/exhibit/screenshot.h"
#include "firmware/exhibit/start_ledger.h"
#include "firmware/exhibit/visitors.h"
#include "firmware/progress.h"
#include "firmware/recording.h"
#include "firmware/verbs/run_settings.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

/// The exhibit from its start to its end, on the machine's clock: the hand's side on its own thread, everything else here. What
/// can fail while it runs is told and lived with; what cannot be lived with ends the program, and the service manager starts it
/// again.
class ExhibitRun {
  public:
    /// Reads the settings and opens nothing yet. Throws InputError or ConfigError for orders that cannot be carried out.
    explicit ExhibitRun(const RunOptions& options);
    /// The exit status.
    int play();

  private:
    // --- the start
    /// How the last run ended, and what follows from that for this one.
    void look_back();
    /// The first settings of which a show can be made: panel, hand and screen as they say.
    void open();
    void open_hand();
    /// Until the first act plays. False: told to stop meanwhile.
    bool first_act();
    void start_hand();
    /// While there is nothing to play yet, as often as one likes: says on the screen, and to the service manager, what takes so
    /// long. False: there is no use in going on with it.
    bool prelude(const std::string& what);

    // --- a turn
    void turn(Instant now, Seconds since_last);
    /// False: there is no use in going on.
    bool heed_screen(Instant now);
    void draw(Instant now);
    /// Tells the service manager, once.
    void get_ready(Instant now);
    void heed_cards(Instant now);
    void heed_panel(Instant now);
    void heed_hand(Instant now);
    void heed_visitors(Instant now);
    void heed_hours(Instant now);
    void heed_settings();
    /// What came of them, at once: in the middle of preparing an act, too.
    void obey_settings();
    void prepare_next();
    /// What became of the act that was announced.
    void follow(const Playbill::News& news);
    void apply_live();
    void allow_force();
    void begin_anew(const std::string& why);
    void shine(Instant now);
    void blink(LampCode code);
    void report(Instant now, bool finally = false);
    void alive();
    void tell_of_hang(std::optional<Part> part);
    int finish();

    /// Whatever is under way.
    bool ends() const;
    bool done() const;
    Instant period() const;
    ExhibitFacts facts() const;
    bool wants_screen() const;
    Office::View view() const;

    RunOptions options_;
    RealClock clock_;
    Office office_{clock_};
    std::filesystem::path state_dir_;  ///< as it was at the start; empty: nothing outlives this run
    std::optional<StartLedger> ledger_;
    StartLedger::Verdict verdict_;
    std::optional<RunSettings> settings_;

    std::unique_ptr<Gpio> gpio_;
    std::optional<Panel> panel_;
    std::optional<HandSide> hand_;
    std::optional<CrashRecord> crash_;  ///< after the hand: it looks at its flights
    std::optional<Front> front_;
    Recording recording_;
    Progress progress_{"run"};

    std::optional<Visitors> visitors_;
    std::optional<Opening> opening_;
    ClockSync clock_sync_;
    std::optional<Screenshot> screenshot_;

    bool hand_runs_ = false;
    Instant hand_began_{0}, show_began_{0};
    bool first_words_ = false, picture_shown_ = false;
    bool first_frame_ = false;  ///< or what stands for it: ready
    bool lost_ = false;         ///< the screen, whatever was tried
    bool again_ = false;        ///< only a new process can help, and nothing has failed
    bool shut_down_ = false;
    bool is_open_ = true;
    Presence presence_ = Presence::Nobody;
    std::string trouble_;  ///< of the panel
    bool button_stuck_ = false;
    std::optional<Instant> guide_until_, blink_until_;
    LampCode blink_ = LampCode::Accepted;
    Instant frame_due_{0}, look_due_{0}, card_due_{0};
    std::uint64_t beats_ = 0;
    std::optional<Part> hanging_;  ///< and the log says so
};

}  // namespace eddy
