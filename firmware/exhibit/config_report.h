#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "config/exhibit.h"

namespace eddy {

/// Where the configuration that runs came from.
enum class ConfigSource { New, LastGood, Factory };
std::string_view to_word(ConfigSource source);

/// What became of what lies in the folder.
enum class ConfigResult {
    Applied,      ///< it runs
    Trying,       ///< it is good; its scene is being built while the old one runs on
    Refused,      ///< something is wrong with it: see errors
    BlackListed,  ///< the program died under it before
    NotRead,      ///< nobody looks at it until the next start: safe mode, or the button was held
};
std::string_view to_word(ConfigResult result);

/// The answer to who wrote a configuration: status/config.json.
struct ConfigReport {
    std::string hash;          ///< of what lies in the folder
    std::string running_hash;  ///< of what runs
    ConfigResult result = ConfigResult::Applied;
    ConfigSource source = ConfigSource::Factory;
    std::string applied_at;  ///< UTC, ISO 8601: since when it runs; empty: not yet
    /// Settings of the factory are in force, all or some, in place of the owner's: nobody knows whether a stop input is wired.
    bool stands_in = false;
    /// The last good ones are in force, and those that cannot be used name another stop input: nobody looks at it.
    bool stop_unread = false;
    bool probation = false;  ///< for 30 s the last good one is kept ready
    std::vector<Diagnostic> errors{};
    std::vector<KeyChange> pending_restart{};
    std::uint64_t applied = 0, refused = 0;  ///< since the start
    int unreadable_state = 0, failed_writes = 0;
    std::string trouble{};  ///< the system's words for the last write that failed
};

/// {hash, running_hash, result, source, stands_in, stop_unread, applied_at, probation, errors[{file, line, column, key, message, hint}],
/// pending_restart[{key, takes_effect, from, to}], applied, refused, unreadable_state, failed_writes, trouble}
std::string to_json(const ConfigReport& report);

/// Replaces FOLDER/config.json for each folder that can be written to; one that cannot does not stop the show.
void write_config_report(const std::vector<std::filesystem::path>& folders, const ConfigReport& report);

}  // namespace eddy
