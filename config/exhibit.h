#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "config/scene_words.h"
#include "config/value.h"

namespace eddy {

enum class DisplayChoice { Auto, Kms, Headless };
enum class HapticsChoice { Auto, Falcon, Emulated, None };
enum class OverlayChoice { None, Cost };
enum class ForceChoice { Model, Filter };

inline constexpr Word<DisplayChoice> kDisplayChoices[] = {
    {DisplayChoice::Auto, "auto", "the screen if there is one"},
    {DisplayChoice::Kms, "kms", "the screen, straight from the kernel"},
    {DisplayChoice::Headless, "headless", "no screen"},
};
inline constexpr Word<HapticsChoice> kHapticsChoices[] = {
    {HapticsChoice::Auto, "auto", "the Falcon if there is one"},
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
    bool operator==(const Exhibit&) const = default;
};

/// An exhibit's settings and where each was written.
struct LoadedExhibit {
    Exhibit exhibit;
    Origins origins;
};

/// Merges what the binary ships (config/exhibit.toml), `folder`/exhibit.toml and `folder`/conf.d/*.toml in
/// the order of their names; the later wins, key by key. Files and folders that do not exist are skipped.
/// max_force_n can only be lowered in conf.d, which a server may fill from afar; the stop input is not set there at all.
/// Throws ConfigError, with everything that is wrong.
LoadedExhibit load_exhibit(const std::filesystem::path& folder = "/etc/eddy");

/// What `file` alone would set, merged over what the binary ships. Throws as load_exhibit() does.
LoadedExhibit load_exhibit_file(const std::filesystem::path& file);

/// Whether a file, of which nothing is said, has a table that is an exhibit's ([falcon]) and no scene's. Throws ConfigError if it
/// cannot be read.
bool holds_an_exhibit_table(const std::string& file);

/// The settings as TOML; with `origins`, a comment after each value says where it came from.
std::string print_exhibit(Exhibit exhibit, const Origins* origins = nullptr);

}  // namespace eddy
