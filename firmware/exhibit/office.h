#pragma once
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "firmware/exhibit/clock_sync.h"
#include "firmware/exhibit/config_report.h"
#include "firmware/exhibit/exhibit_state.h"
#include "firmware/exhibit/front.h"
#include "firmware/exhibit/hand_side.h"
#include "firmware/exhibit/journal.h"
#include "firmware/exhibit/opening_hours.h"
#include "firmware/exhibit/service.h"
#include "firmware/exhibit/usage.h"

namespace eddy {

/// What those who look after the exhibit are told of it: the log, the service manager, usage by the day, status.json and metrics, the
/// guide page. It takes no part in the show, and nothing here throws for want of a disk or a reader. GL thread only.
class Office {
  public:
    /// What it looks at.
    struct View {
        const Exhibit& exhibit;
        const Scene& scene;
        const ConfigReport& settings;
        bool settings_good;          ///< the last that were read were taken
        double settings_taken_at_s;  ///< UTC since 1970; 0: never
        const Front& front;
        const HandSide& hand;
        const Opening& opening;
        const ClockSync& clock_sync;
        ExhibitFacts facts;
        const std::string& trouble;  ///< of the panel
    };

    /// `clock`: the run's. It must outlive this.
    explicit Office(const Clock& clock);

    // --- the log
    void say(Event event, const std::string& message, const LogSink::Fields& fields = {});
    /// Something could not be written: says it, and counts it.
    void disk_trouble(const std::string& what);
    /// With the seconds since the program's start.
    void say_when(Event event, const std::string& message);
    Journal& journal() { return journal_; }

    // --- the service manager
    bool has_manager() const { return notify_.listened_to(); }
    Service& service() { return service_; }

    // --- usage
    /// Counting goes on in this folder; nothing is counted before.
    void count_in(const std::filesystem::path& state_dir);
    void count(double Usage::*what, double much = 1.0);

    // --- each turn
    /// What is new on both sides, for the log.
    void tell_news(Front& front, HandSide& hand);
    FrameTimes& frame_times() { return frame_times_; }
    /// Once a second by itself; `finally`: in any case. True: it was written.
    bool report(Instant now, const View& view, bool finally = false);
    /// Lines for the screen.
    std::vector<std::string> guide_page(const View& view) const;
    /// Writes what was counted, says what was held back.
    void close();

  private:
    VitalSigns vital_signs(const View& view) const;
    void tell_of_hand(const HandSide& hand);
    void write_figures(Instant now, const View& view);
    static std::time_t wall_time() { return std::time(nullptr); }

    const Clock& clock_;
    Journal journal_;
    ServiceNotify notify_;
    Service service_;
    std::optional<UsageBook> usage_;
    FrameTimes frame_times_;
    Instant report_due_{0};
    std::optional<double> temperature_c_;  ///< as of the last report: the guide page is drawn far more often
    std::uint64_t disk_errors_ = 0;
    int settings_unwritten_ = 0;                ///< as told last
    std::uint64_t gpu_resets_ = 0;              ///< as told last
    HapticState device_ = HapticState::Absent;  ///< likewise
    GateReason force_ = GateReason::Disabled;   ///< so far
};

}  // namespace eddy
