#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/diagnostic.h"
#include "config/scene_words.h"

namespace eddy {

/// Everything a scene file says: an exhibit scene and a physics case alike. All lengths and directions are in
/// the Tank frame (hal/frames.h): origin at the low corner of the fluid, x right, y up, z towards the
/// visitor. Ranges, defaults and meaning of each key are in scene_schema.h; its reference is
/// schema_reference().
struct Scene {
    struct Walls {
        WallKind x_low = WallKind::Slip;
        WallKind x_high = WallKind::Slip;
        WallKind y_low = WallKind::Slip;
        WallKind y_high = WallKind::Slip;
        WallKind z_low = WallKind::Slip;
        WallKind z_high = WallKind::Slip;
        bool operator==(const Walls&) const = default;
    };

    struct Tank {
        glm::dvec3 size_m{0.16};
        glm::ivec3 cells{64};
        Walls walls;
        bool operator==(const Tank&) const = default;

        /// The width of a cell [m]; load_scene() made sure that it is the same along all axes.
        double cell_m() const { return size_m.x / cells.x; }
    };

    struct Fluid {
        double density_kg_m3 = 1.2;
        bool operator==(const Fluid&) const = default;
    };

    struct Smoke {
        double dissipation_1_s = 0.0;
        bool operator==(const Smoke&) const = default;
    };

    struct Source {
        std::string name;
        glm::dvec3 centre_m{0.0};
        double radius_m = 0.0;
        std::optional<double> smoke_per_s;
        std::optional<glm::dvec3> velocity_m_s;
        double start_s = 0.0;
        std::optional<double> stop_s;
        bool operator==(const Source&) const = default;
    };

    struct Oscillation {
        glm::dvec3 amplitude_m{0.0};
        double frequency_hz = 0.0;
        double phase_rad = 0.0;
        bool operator==(const Oscillation&) const = default;
    };

    /// A prescribed body is at centre_m + velocity_m_s t + acceleration_m_s2 t²/2 + amplitude_m sin(2π
    /// frequency_hz t + phase_rad) + path(t), where t is the time since start_s, or 0 before that.
    struct Body {
        std::string name;
        BodyShape shape = BodyShape::Sphere;
        double radius_m = 0.0;
        glm::dvec3 centre_m{0.0};
        BodyMotion motion = BodyMotion::Fixed;
        glm::dvec3 velocity_m_s{0.0};
        glm::dvec3 acceleration_m_s2{0.0};
        glm::dvec3 spin_rad_s{0.0};
        std::filesystem::path path_csv;  ///< absolute; empty: none
        double start_s = 0.0;
        bool force = true;
        bool torque = true;
        std::optional<Oscillation> oscillation;
        bool operator==(const Body&) const = default;
    };

    struct Initial {
        glm::dvec3 velocity_m_s{0.0};
        bool operator==(const Initial&) const = default;
    };

    struct Solver {
        SolverPreset preset = SolverPreset::Fast;
        double dt_s = 0.02;
        std::optional<AdvectionScheme> advection;
        std::optional<int> cycles;
        std::optional<int> jacobi_sweeps;
        bool operator==(const Solver&) const = default;
    };

    struct Haptics {
        double gain = 1.0;
        double max_force_n = 4.0;
        double workspace_scale = 1.0;
        glm::dvec3 centre_m{0.08};
        bool operator==(const Haptics&) const = default;
    };

    struct Render {
        int width_px = 640;
        int height_px = 480;
        double azimuth_deg = 20.0;
        double elevation_deg = 15.0;
        double distance_factor = 1.5;
        glm::dvec3 smoke_colour{0.90, 0.93, 0.97};
        glm::dvec3 background_colour{0.02, 0.03, 0.06};
        double exposure = 1.0;
        double extinction_1_m = 60.0;
        bool operator==(const Render&) const = default;
    };

    struct Outputs {
        double duration_s = 10.0;
        bool series = true;
        std::vector<OutputField> fields;
        bool operator==(const Outputs&) const = default;
    };

    std::string title;
    std::string description;
    Tank tank;
    Fluid fluid;
    std::optional<Smoke> smoke;  ///< effects: present is on
    std::vector<Source> sources;
    std::vector<Body> bodies;  ///< at most one is held
    Initial initial;
    Solver solver;
    Haptics haptics;
    Render render;
    Outputs outputs;
    bool operator==(const Scene&) const = default;
};

/// A scene and where each of its values was written.
struct LoadedScene {
    Scene scene;
    Origins origins;
};

/// Loads a scene: a file, when `path_or_name` holds a slash or ends in ".toml", otherwise a shipped scene by
/// its name
/// ("jet"). `overrides` are "key=value" as apply_override() takes them. Defaults that follow from other
/// values are filled in: names, the held body's and the hand's centre; path_csv is absolute (taken from the
/// scene file's folder; in an override, from the current one). Throws ConfigError, with everything that is
/// wrong.
LoadedScene load_scene(const std::string& path_or_name, std::span<const std::string> overrides = {});

/// The same from text; `file` is what diagnostics call it, and path_csv starts from its folder.
LoadedScene read_scene(std::string_view text, const std::string& file,
                       std::span<const std::string> overrides = {});

/// The whole scene as TOML, defaults included; it reads back to the same scene. With `origins`, a comment
/// after each value says where it came from.
std::string print_scene(Scene scene, const Origins* origins = nullptr);

/// The names of the scenes in the binary, sorted.
std::vector<std::string_view> shipped_scenes();
bool is_scene_file(std::string_view path_or_name);

/// All keys of a scene file as markdown tables (docs/scene.md).
std::string schema_reference();

}  // namespace eddy
