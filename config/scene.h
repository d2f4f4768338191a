#pragma once
#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/body_sizes.h"
#include "config/diagnostic.h"
#include "config/formula.h"
#include "config/scene_words.h"

namespace eddy {

/// Everything a scene file says: an exhibit scene and a physics case alike. All lengths and directions are in
/// the Tank frame (hal/frames.h): origin at the low corner of the fluid, x right, y up, z towards the
/// visitor. Ranges, defaults and meaning of each key are in scene_schema.h and what it includes; its
/// reference is schema_reference().
struct Scene {
    struct Wall {
        WallKind kind = WallKind::Slip;
        std::optional<FormulaVector> velocity_m_s;  ///< inflow: always; no_slip: absent is at rest
        bool operator==(const Wall&) const = default;
    };

    struct Walls {
        Wall x_low;
        Wall x_high;
        Wall y_low;
        Wall y_high;
        Wall z_low;
        Wall z_high;
        bool operator==(const Walls&) const = default;

        /// In this order.
        std::array<const Wall*, 6> all() const { return {&x_low, &x_high, &y_low, &y_high, &z_low, &z_high}; }
        std::array<Wall*, 6> all() { return {&x_low, &x_high, &y_low, &y_high, &z_low, &z_high}; }
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
        double viscosity_pa_s = 0.0;  ///< dynamic
        glm::dvec3 gravity_m_s2{0.0};
        bool operator==(const Fluid&) const = default;
    };

    /// Excess over a reference at which the fluid has its density.
    struct Temperature {
        double expansion_1_k = 0.0;
        double diffusivity_m2_s = 0.0;
        Formula initial_k;
        bool operator==(const Temperature&) const = default;
    };

    struct Smoke {
        double dissipation_1_s = 0.0;
        double weight = 0.0;  ///< relative density excess of fluid with smoke of density 1
        Formula initial;
        bool operator==(const Smoke&) const = default;
    };

    struct VorticityConfinement {
        double strength_1_s = 0.0;
        bool operator==(const VorticityConfinement&) const = default;
    };

    struct Source {
        std::string name;
        glm::dvec3 centre_m{0.0};
        double radius_m = 0.0;
        std::optional<double> smoke_per_s;
        std::optional<double> temperature_k_per_s;
        std::optional<glm::dvec3> velocity_m_s;
        double start_s = 0.0;
        std::optional<double> stop_s;
        bool operator==(const Source&) const = default;
    };

    struct Oscillation {
        glm::dvec3 amplitude_m{0.0};
        double frequency_hz = 0.0;
        double phase_rad = 0.0;
        glm::dvec3 axis{0.0, 0.0, 1.0};  ///< of any length but 0
        double angle_deg = 0.0;          ///< amplitude of the turn about it
        bool operator==(const Oscillation&) const = default;
    };

    /// A prescribed body is at centre_m + velocity_m_s t + acceleration_m_s2 t²/2 + amplitude_m s + path(t),
    /// with s = sin(2π frequency_hz t + phase_rad) and t the time since start_s, or 0 before that. From its
    /// orientation() it is turned either by spin_rad_s t or by the oscillation's angle_deg s.
    struct Body {
        std::string name;
        BodyShape shape = BodyShape::Sphere;
        // Sizes: those that the shape has (body_sizes.h) are set, the others stay at 0.
        double radius_m = 0.0;
        glm::dvec3 size_m{0.0};
        double length_m = 0.0;
        double tube_radius_m = 0.0;
        glm::dvec3 radii_m{0.0};
        double thickness_m = 0.0;
        glm::dvec3 blade_m{0.0};
        double handle_radius_m = 0.0;
        double handle_length_m = 0.0;
        double edge_m = 0.0;
        std::filesystem::path file;  ///< absolute
        double scale = 1.0;          ///< [m] for a unit of the file
        bool inside_out = false;     ///< solid outside the shape: a container
        glm::dvec3 centre_m{0.0};
        glm::dvec3 axis{0.0, 0.0, 1.0};  ///< of any length but 0
        double angle_deg = 0.0;
        BodyMotion motion = BodyMotion::Fixed;
        std::optional<double> density_kg_m3;  ///< free: always; turning: may be given
        bool turning = false;
        glm::dvec3 velocity_m_s{0.0};
        glm::dvec3 acceleration_m_s2{0.0};
        glm::dvec3 spin_rad_s{0.0};
        std::filesystem::path path_csv;  ///< absolute; empty: none
        double start_s = 0.0;
        bool force = true;
        bool torque = true;
        std::optional<Oscillation> oscillation;
        bool operator==(const Body&) const = default;

        /// At the start, from the body's own axes to the tank's.
        glm::dquat orientation() const {
            return glm::angleAxis(glm::radians(angle_deg), glm::normalize(axis));
        }
    };

    struct Initial {
        FormulaVector velocity_m_s;
        std::filesystem::path velocity_npy;  ///< absolute; empty: none
        bool operator==(const Initial&) const = default;
    };

    struct Forcing {
        FormulaVector acceleration_m_s2;
        bool operator==(const Forcing&) const = default;
    };

    /// The flow is this instead of being solved for.
    struct Imposed {
        FormulaVector velocity_m_s;
        bool operator==(const Imposed&) const = default;
    };

    struct Solver {
        SolverPreset preset = SolverPreset::Fast;
        double dt_s = 0.02;
        std::optional<AdvectionScheme> advection;
        std::optional<int> cycles;
        std::optional<int> viscous_cycles;
        int time_order = 1;
        std::optional<int> jacobi_sweeps;
        std::optional<ForceSum> force_sum;
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

    /// Either at point_m, or at `points` points from from_m to to_m, both included.
    struct Probe {
        std::string name;
        ProbeQuantity quantity = ProbeQuantity::Velocity;
        std::optional<glm::dvec3> point_m;
        std::optional<glm::dvec3> from_m;
        std::optional<glm::dvec3> to_m;
        std::optional<int> points;
        bool operator==(const Probe&) const = default;

        /// Where it measures, in order.
        std::vector<glm::dvec3> places_m() const;
    };

    struct Outputs {
        double duration_s = 10.0;
        bool series = true;
        bool force_methods = false;
        std::vector<OutputField> fields;
        bool operator==(const Outputs&) const = default;
    };

    std::string title;
    std::string description;
    Tank tank;
    Fluid fluid;
    // Effects: present is on.
    std::optional<Temperature> temperature;
    std::optional<Smoke> smoke;
    std::optional<VorticityConfinement> vorticity_confinement;
    std::optional<Forcing> forcing;
    std::optional<Imposed> imposed;
    std::vector<Source> sources;
    std::vector<Body> bodies;  ///< at most one is held
    Initial initial;
    Solver solver;
    Haptics haptics;
    Render render;
    std::vector<Probe> probes;
    Outputs outputs;
    bool operator==(const Scene&) const = default;
};

/// A scene and where each of its values was written.
struct LoadedScene {
    Scene scene;
    Origins origins;
};

/// Loads a scene: a file, when `path_or_name` holds a slash or ends in ".toml", otherwise a shipped scene by
/// its name ("jet", "validation/A1"). `overrides` are "key=value" as apply_override() takes them. Defaults that follow from
/// other values are filled in: names, the held body's and the hand's centre; file names are absolute (taken
/// from the scene file's folder; in an override, from the current one). Throws ConfigError, with everything
/// that is wrong.
LoadedScene load_scene(const std::string& path_or_name, std::span<const std::string> overrides = {});

/// The same from text; `file` is what diagnostics call it, and file names start from its folder.
LoadedScene read_scene(std::string_view text, const std::string& file,
                       std::span<const std::string> overrides = {});

/// The whole scene as TOML, defaults included; it reads back to the same scene. With `origins`, a comment
/// after each value says where it came from.
std::string print_scene(Scene scene, const Origins* origins = nullptr);

/// The names of the scenes in the binary, sorted.
std::vector<std::string_view> shipped_scenes();
/// And of those that `eddy accuracy` runs: "validation/A1".
std::vector<std::string_view> validation_scenes();
/// Whether load_scene() would take it for a file.
bool is_scene_file(std::string_view path_or_name);

/// Whether a file holds a scene rather than an exhibit's settings, judged by its top-level keys: those of an
/// exhibit are plain values, a scene has tables. Throws ConfigError if it cannot be read or is not TOML.
bool holds_a_scene(const std::string& file);

/// All keys of a scene file as markdown tables (docs/scene.md).
std::string schema_reference();

}  // namespace eddy
