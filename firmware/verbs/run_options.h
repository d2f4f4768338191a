#pragma once
#include "config/scene.h"
#include "firmware/exhibit/act.h"
#include "firmware/haptic/hand_tick.h"
#include "firmware/quality/quality_control.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

// What the options of a run come to, with the exhibit's settings where they say nothing.

inline Instant instant(Seconds s) {
    return std::chrono::duration_cast<Instant>(s);
}

/// The exhibit's settings, but for what the command line says otherwise.
Exhibit with_options(Exhibit exhibit, const RunOptions& options);

/// How the act of a scene is to be played. A run on the stepped clock is the same on every machine: it keeps the scene's own quality.
Act::Setup act_setup(const RunOptions& options, const Exhibit& exhibit, const Scene& scene, bool has_picture,
                     bool has_hand);
HapticLoopSettings loop_settings(const Exhibit& exhibit);
/// Where the seconds before a fault go. Where the exhibit keeps nothing else, it keeps no flights either: empty.
std::filesystem::path flights_folder(const Exhibit& exhibit);

/// Throws InputError, with the option's name, for what no run of this scene can do.
void require_possible(const RunOptions& options, const Exhibit& exhibit, const Scene& scene);
/// Makes the folders for state and status that options name; throws InputError for those that cannot be.
void prepare_folders(const RunOptions& options);

}  // namespace eddy
