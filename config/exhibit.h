#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "config/opening_hours.h"
#include "config/scene_words.h"
#include "config/takes_effect.h"
#include "config/value.h"
#include "config/written_file.h"

namespace eddy {

enum class DisplayChoice { Auto, Kms, Headless };
enum class HapticsChoice { Auto, Falcon, Emulated, None };
enum class OverlayChoice { None, Cost };
enum class ForceChoice { Model, Filter };

inline constexpr Word<DisplayChoice> kDisplayChoices[] = {
    {DisplayChoice::Auto, "auto", "the screen if there is one"},
    {DisplayChoice::Kms, "kms",
     "the screen, straight from the kernel; none is an error, but a service waits for its graphics card"},
    {DisplayChoice::Headless, "headless", "no screen"},
};
inline constexpr Word<HapticsChoice> kHapticsChoices[] = {
    {HapticsChoice::Auto, "auto",
     "the Falcon, which a service waits for; else, and there is none, a simulated hand"},
    {HapticsChoice::Falcon, "falcon", "the Falcon"},
    {HapticsChoice::Emulated, "emulated", "a simulated hand"},
    {HapticsChoice::None, "none", "no hand"},
};
inline constexpr Word<OverlayChoice> kOverlayChoices[] = {
    {OverlayChoice::None, "none", "the picture alone"},
    {OverlayChoice::Cost, "cost",
     "what accuracy costs: steps a second, ms a stage, error and ripple of the force"},
};

inline constexpr Word<ForceChoice> kForceChoices[] = {
    {ForceChoice::Model, "model",
     "what follows from the hand's own motion at once, from slopes found while it moves; the rest "
     "low-passed"},
    {ForceChoice::Filter, "filter", "all of it held and low-passed, as Yang et al. 2009"},
};

constexpr std::span<const Word<DisplayChoice>> words_of(DisplayChoice) {
    return kDisplayChoices;
}
constexpr std::span<const Word<HapticsChoice>> words_of(HapticsChoice) {
    return kHapticsChoices;
}
constexpr std::span<const Word<OverlayChoice>> words_of(OverlayChoice) {
    return kOverlayChoices;
}
constexpr std::span<const Word<ForceChoice>> words_of(ForceChoice) {
    return kForceChoices;
}

/// A Falcon's motor value for a newton metre at the arm is between these: a tenth of what its public sources say, and ten times it.
inline constexpr double kLeastMotorUnitsPerNm = 1000.0, kMostMotorUnitsPerNm = 100000.0;

/// The Novint Falcon of this machine, and what its public sources leave open.
struct FalconConfig {
    std::string firmware{};  ///< path of the image that a cold device is loaded with
    std::string serial{};
    double motor_units_per_nm = 10000.0;
    bool keep_homing_bit = true;
    bool event_character = true;
    bool operator==(const FalconConfig&) const = default;
};

/// Button, stop input and lamps of this machine; each line by its name or as CHIP:OFFSET, empty: there is none.
struct GpioConfig {
    std::string button{};
    std::string stop{};
    std::string lamp_green{}, lamp_amber{}, lamp_red{};
    bool button_active_low = true;
    bool stop_active_low = false;
    bool lamps_active_low = false;
    bool operator==(const GpioConfig&) const = default;
};

/// A visitor who touches nothing for so long is gone.
inline constexpr double kLeastIdle_s = 10.0, kMostIdle_s = 600.0;

/// [unattended]: what goes on without anybody of the house.
struct UnattendedConfig {
    double idle_after_s = 45.0;
    std::string metrics_file{};  ///< empty: eddy.prom in run_dir
    bool operator==(const UnattendedConfig&) const = default;
};

/// The screen, and how large a picture is drawn for it.
struct ScreenConfig {
    std::string connector{};
    std::string mode{};
    int max_pixels = 921600;
    bool operator==(const ScreenConfig&) const = default;
};

/// What an exhibit machine is set to. exhibit.cpp has each key's meaning and range, exhibit.toml its value.
struct Exhibit {
    std::string scene = "jet";  ///< as load_scene() takes it
    DisplayChoice display = DisplayChoice::Auto;
    HapticsChoice haptics = HapticsChoice::Auto;
    ForceChoice force = ForceChoice::Model;
    OverlayChoice overlay = OverlayChoice::None;
    std::vector<SolverPreset> presets{};
    double preset_s = 0.0;
    std::filesystem::path state_dir = "/var/lib/eddy";
    std::filesystem::path run_dir = "/run/eddy";
    double max_force_n = 4.0;
    FalconConfig falcon{};
    GpioConfig gpio{};
    HoursConfig hours{};
    UnattendedConfig unattended{};
    ScreenConfig screen{};
    bool operator==(const Exhibit&) const = default;
};

/// An exhibit's settings and where each was written.
struct LoadedExhibit {
    Exhibit exhibit;
    Origins origins;
};

/// The files of a configuration folder, read once.
struct ExhibitFiles {
    std::filesystem::path folder;  ///< absolute; scenes are named from here
    std::vector<WrittenFile> own;  ///< exhibit.toml, if there is one: the machine's own
    std::vector<WrittenFile>
        drop_ins;  ///< conf.d/*.toml, in the order of their names; what a fleet's server may fill
    std::vector<WrittenFile> sums;        ///< *.sha256 beside those
    std::vector<Diagnostic> diagnostics;  ///< of what could not be read, or seems not to be whole

    bool none() const { return own.empty() && drop_ins.empty() && diagnostics.empty(); }
};

/// Reads the files, by the rules of read_written_file(); in conf.d symbolic links do not count. What does not exist is skipped,
/// so are names that begin with a dot.
ExhibitFiles read_exhibit_files(const std::filesystem::path& folder);

/// What the files say, and everything that is wrong: of each file, then of all together.
struct ExhibitReading {
    LoadedExhibit loaded;
    std::vector<Diagnostic> diagnostics;
};

/// Merges what the binary ships (config/exhibit.toml), exhibit.toml and conf.d in their order; the later wins, key by key.
/// max_force_n can only be lowered in conf.d, and the stop input is not set there at all. A scene file that is named by a relative path is sought from the folder.
ExhibitReading read_exhibit(const ExhibitFiles& files);

inline constexpr const char* kConfigFolder = "/etc/eddy";

/// Both of the above; throws ConfigError, with everything that is wrong.
LoadedExhibit load_exhibit(const std::filesystem::path& folder);

/// What `file` alone would set, merged over what the binary ships. Throws as load_exhibit() does.
LoadedExhibit load_exhibit_file(const std::filesystem::path& file);

/// A key whose value is another one, and when the new one counts.
struct KeyChange {
    std::string key;
    TakesEffect takes_effect = TakesEffect::Process;
    std::string from, to;  ///< as TOML; of a list of tables: how many
    bool operator==(const KeyChange&) const = default;
};
std::vector<KeyChange> changed_keys(Exhibit from, Exhibit to);

/// `next`, but with the values of `running` where new ones count only after a restart.
Exhibit without_restart(Exhibit running, Exhibit next);

/// Whether an exhibit's settings have a value, or list of tables, of this name at the top; or a table.
bool is_exhibit_key(std::string_view name);
bool is_exhibit_table(std::string_view name);

/// The settings as TOML; with `origins`, a comment after each value says where it came from.
std::string print_exhibit(Exhibit exhibit, const Origins* origins = nullptr);

/// All keys of the settings as markdown tables (the end of docs/config.md).
std::string exhibit_reference();
/// The same as a JSON Schema (docs/exhibit.schema.json), for editors.
std::string exhibit_schema();

}  // namespace eddy
