#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/exhibit/state_file.h"

namespace eddy {

/// How the run before this one ended.
enum class EndBefore : std::uint8_t {
    None,      ///< there was none
    Well,      ///< when it was told to
    Failed,    ///< it crashed, or was ended because it hung
    PowerLost  ///< the machine went away under it
};

/// Keeps the last starts of the program in a file, and decides from them how this one is to be. eddy.service starts the
/// machine anew after kBurst failures within kBurst_s; when that has not helped kMostRestarts times in a row within an hour, the
/// program goes on in safe mode: the settings of the factory, no force, and a minute between two starts, so that the machine is not
/// started again. Whoever switches it off and on then tries anew.
/// A program that ended because only a new process could help (its screen is on another card) has not failed; should that happen
/// again and again, the starts are spread out until systemd takes no offence.
/// A file named `safe` beside the ledger asks for the same. An hour after the last such restart of the machine, a start is as
/// usual again.
class StartLedger {
  public:
    // As eddy.service has them: StartLimitBurst=, StartLimitIntervalSec=.
    static constexpr int kBurst = 5;
    static constexpr std::int64_t kBurst_s = 300;
    static constexpr int kMostRestarts = 3;
    static constexpr std::int64_t kHour_s = 3600;
    /// Between starts in safe mode; kBurst of them take longer than kBurst_s.
    static constexpr std::int64_t kSafeStep_s = kBurst_s / (kBurst - 1) + 1;
    /// The same after one that asked for the next: of kBurst, two follow at once.
    static constexpr std::int64_t kAgainStep_s = kBurst_s / (kBurst - 2) + 1;

    struct Verdict {
        EndBefore before = EndBefore::None;
        int restarts = 0;   ///< of the machine within the last hour, in a row, because the program failed
        bool safe = false;  ///< safe mode
        bool asked_for = false;   ///< by the file
        std::int64_t wait_s = 0;  ///< before anything else is tried
        bool written = true;      ///< the start could be put down
    };

    /// `folder`: that of the state.
    explicit StartLedger(const std::filesystem::path& folder, Disk& disk = real_disk());

    /// This start: `now_s` by the machine's clock (seconds UTC, which may have been set meanwhile), and what names this
    /// boot of the machine.
    Verdict begin(std::int64_t now_s, const std::string& boot);
    /// The program ends because it was told to.
    void end_well() { end(End::Well); }
    /// The program ends so that it is started again.
    void end_for_restart() { end(End::Again); }

  private:
    enum class End : std::uint8_t { None, Well, Again };
    static constexpr std::string_view kEnds[] = {"-", "well", "again"};
    struct Start {
        std::int64_t at_s = 0;
        std::string boot;
        End end = End::None;
    };
    void end(End end);
    std::vector<Start> read();
    bool write();
    /// The machine was started anew after this boot's failures; when the last of them was.
    bool gave_up(const std::string& boot, std::int64_t& at_s) const;

    StateFile file_;
    std::filesystem::path marker_;
    std::vector<Start> starts_;
};

/// What the kernel calls this boot of the machine; empty if it does not say.
std::string boot_id();

}  // namespace eddy
