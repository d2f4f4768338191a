#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/exhibit/config_set.h"
#include "firmware/exhibit/state_file.h"

namespace eddy {

/// What a machine remembers of its configurations through restarts and power cuts: the last that was good, which one is being
/// tried, and those under which the program died. In the folder: last-good, files/ (what its scene names), probation,
/// black-list. Nothing here throws: what cannot be read is as if not there, what cannot be written is counted. One thread.
class ConfigMemory {
  public:
    /// A power cut during probation is no proof; so many in a row are.
    static constexpr int kMostCuts = 3;
    static constexpr std::size_t kMostBlackListed = 64;

    /// `folder` empty: nothing is remembered. `boot` is another string after each start of the machine. What one `program` died under
    /// another may be the cure for.
    ConfigMemory(std::filesystem::path folder, std::string boot, std::string program,
                 Disk& disk = real_disk());

    /// Looks what became of the one on probation when the program, or the machine, stopped: returns its hash if it is on the
    /// black list for that. To be asked once, at the start.
    std::optional<std::string> judge();

    /// It is still good; the files that its scene names are the copies.
    std::optional<ConfigSet> last_good(const SceneOrders& orders);
    /// The hash of what that returned, or of what was kept since; empty: there is none.
    const std::string& last_good_hash() const { return last_good_hash_; }
    /// There was one to look at, whatever last_good() could make of it: somebody has set something.
    bool had_last_good() const { return had_last_good_; }
    void keep_as_last_good(const ConfigSet& set);

    void begin_probation(const std::string& hash);
    void end_probation();
    /// The hash of the one on probation; empty: none is.
    const std::string& on_probation() const { return on_probation_; }

    bool black_listed(const std::string& hash) const;

    int unreadable() const {
        return unreadable_ + last_good_.unreadable() + probation_.unreadable() + black_list_.unreadable();
    }
    int failed_writes() const { return failed_writes_; }
    /// The system's words for the last of them.
    const std::string& trouble() const { return trouble_; }

  private:
    template <class Action>
    void attempt(Action action);
    void black_list(const std::string& hash);
    void write_probation();

    std::filesystem::path folder_;
    std::string boot_, program_;
    Disk& disk_;
    StateFile last_good_, probation_, black_list_;
    std::string last_good_hash_;
    bool had_last_good_ = false;
    std::string on_probation_;
    int cuts_ = 0;  ///< that this one has seen while on probation
    struct Death {
        std::string hash, program;  ///< written before programs were told apart: of none
        bool operator==(const Death&) const = default;
    };
    std::vector<Death> black_listed_;  ///< oldest first
    int unreadable_ = 0;
    int failed_writes_ = 0;
    std::string trouble_;
};

}  // namespace eddy
