#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/quality/quality.h"

namespace eddy {

/// A setting, what it costs on a machine and what it is worth.
struct Rung {
    Quality quality;
    double step_ms = 0.0, step_ms_p95 = 0.0;  ///< wall time of a step of the scene
    /// Share of the force on a ball, as many cells across as the body in the hand, that speeds up (force_error.h).
    double force_error = 0.0;
    bool operator==(const Rung&) const = default;
};

/// What a machine was found to be able to do with a scene, and the evidence. Kept in the state folder, a file for each scene.
struct Tuning {
    std::string version, renderer, machine;
    std::string made_at;  ///< UTC, ISO 8601
    std::string scene;    ///< as TOML: another scene is another tuning
    double target_hz = 0.0;
    double picture_ms = 0.0;       ///< of drawing one picture
    double budget_ms = 0.0;        ///< for a step: what pictures leave of a period
    std::vector<Rung> measured{};  ///< everything that was tried
    std::vector<Rung> ladder{};    ///< those that none beats in time without being less exact; cheapest first
    std::size_t chosen = 0;        ///< of the ladder
    bool operator==(const Tuning&) const = default;
};

/// Steps may take this share of what is allowed, 95 of 100 of them: the rest is for what the machine does besides.
inline constexpr double kTuningMargin = 0.8;

/// Fills in ladder and chosen from what was measured: the most exact that keeps the budget with its margin, else the cheapest.
void choose(Tuning& tuning);

std::string to_json(const Tuning& tuning);
/// Throws InputError that names the file.
Tuning tuning_from_json(const std::string& text, const std::filesystem::path& file);

/// tuning-jet.json of the scene "jet"; `scene` as load_scene() takes it. Of a scene file counts the name, not the folder. Letters
/// and digits stay as they are, others than of ASCII too; what a file name had better not have becomes a hyphen.
std::filesystem::path tuning_file(const std::filesystem::path& state_dir, const std::string& scene);
/// The tuning in this file, if it is one of this program, renderer and scene. One that cannot be read counts as none; `trouble`
/// says why there is none.
std::optional<Tuning> stored_tuning(const std::filesystem::path& file, const Scene& scene,
                                    const std::string& renderer, std::string& trouble);

}  // namespace eddy
