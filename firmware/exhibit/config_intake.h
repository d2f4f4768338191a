#pragma once
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "firmware/exhibit/config_memory.h"
#include "firmware/exhibit/config_report.h"
#include "firmware/exhibit/config_set.h"
#include "hal/folder_watch.h"

namespace eddy {

/// A configuration that passed every check short of building it.
struct ConfigOffer {
    std::string hash;
    ConfigSource source = ConfigSource::New;
    /// What to run with from now on: keys that count only after a restart are as they were.
    Exhibit exhibit;
    /// The scene, as checked; not to be read again, for its files may be others by then.
    LoadedScene scene;
    std::vector<KeyChange>
        changes{};  ///< since what runs, or is being built; "scene" too when only its file is another

    /// Whether more than `live` keys changed: the old show runs on until the new scene is built.
    bool needs_new_scene() const;
};

/// Takes the exhibit's settings from a folder into which anybody may write at any time, so that no file stops the show:
///
///     start() -> build it -> accepted(), or refused() and start() again: what lies in the folder, the last good one, the
///                            factory's, in this order
///     poll()  -> now and then an offer -> build it beside the show -> accepted() just before the swap, or refused()
///     stopped() when the program ends because it was asked to
///
/// A new configuration is on probation for 30 s: if the program dies in them it is on the black list from the next start on,
/// until another program is installed, and the last good one runs; if it does not, it is the last good one. A power cut alone condemns nobody (until the third).
///
/// One thread. poll() neither waits nor reads files, but for a look at the folder each five seconds: reading, checking and
/// keeping are done on a thread of their own. accepted() writes one small file to the disk and waits for that.
class ConfigIntake {
  public:
    struct Setup {
        std::filesystem::path folder = kConfigFolder;
        /// Memory is in config/ of it. Not the key state_dir: it must be found before any key is read. Empty: no memory.
        std::filesystem::path state_dir{};
        /// The answer goes to status/config.json in it; empty: the exhibit's run_dir. And to status/ beside the settings, if
        /// the owner made that folder.
        std::filesystem::path run_dir{};
        SceneOrders orders{};
        bool factory_only = false;  ///< safe mode: files are neither read nor watched
        std::string boot{};         ///< another one after each start of the machine; empty: the kernel's
        std::string program{};      ///< another one after each update; empty: this
    };

    static constexpr Instant kQuiet = std::chrono::milliseconds(250);
    static constexpr Instant kProbation = std::chrono::seconds(30);
    static constexpr Instant kHeldUp = std::chrono::seconds(60);

    explicit ConfigIntake(Setup setup, Disk& disk = real_disk());

    /// What to run with; again after refused(). Throws ConfigError if the orders of the command line are wrong, or not even the
    /// factory's settings can be built.
    ConfigOffer start();

    /// A new configuration, if there is one; the next only after accepted() or refused(). But before the first is accepted, a new one
    /// overtakes what is being built: its changes are since that, and if it is refused, that is still being built.
    std::optional<ConfigOffer> poll(Instant now);

    /// What was offered is being built from now on, or takes effect beside what is: should the program die of that, it is on the
    /// black list too.
    void building(const std::string& hash);
    void accepted(const std::string& hash, Instant now);
    /// `reason` is one line for the operator; the show goes on as it is.
    void refused(const std::string& hash, const std::string& reason);
    void stopped();

    /// Something is being read or kept.
    bool busy() const { return reading_.valid() || keeping_.valid(); }
    /// And has been for longer than any disk takes that works: files that come meanwhile have to wait.
    bool is_held_up(Instant now) const;
    const ConfigReport& report() const { return report_; }

  private:
    struct Objection {
        ConfigResult result;
        std::vector<Diagnostic> errors;
    };

    struct Open {
        ConfigSet set;
        ConfigSource source;
    };

    ConfigOffer offer(ConfigSet set, ConfigSource source);
    bool is_proven(const Open& open) const;
    void blame(const std::string& hash);
    std::optional<ConfigOffer> consider(ConfigSet set);
    std::optional<ConfigSet> good_one_in_folder();
    std::optional<Objection> objection(const ConfigSet& set) const;
    void refuse(ConfigResult result, std::vector<Diagnostic> errors);
    void watch(const ConfigSet& set);
    void publish();

    Setup setup_;
    ConfigMemory memory_;
    FolderWatch watch_;
    ConfigReport report_;

    bool started_ = false;
    std::optional<ConfigSet> last_good_;  ///< at the start
    std::optional<Open> open_;            ///< offered, not answered yet
    std::optional<Open> overtaken_;       ///< by that; open again if that is refused
    std::optional<Exhibit> in_force_;     ///< what does not change without a restart is as in this
    std::optional<ConfigSet> running_;
    std::vector<std::string> refused_;  ///< since the start, by the caller

    std::optional<Instant> quiet_until_;
    std::future<ConfigSet> reading_;
    std::future<void> keeping_;
    Instant busy_since_{0};  ///< if it is
    std::optional<Instant> probation_until_;
};

}  // namespace eddy
