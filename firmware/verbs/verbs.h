#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/exhibit.h"
#include "firmware/exhibit/lamps.h"
#include "firmware/input_error.h"

namespace eddy {

// The verbs of the command line. Each returns the exit status: 0 done, 1 failed. Bad input is thrown
// (ConfigError, InputError) and becomes 2 in main.cpp, before any work was done.

struct SimulateOptions {
    std::string scene;
    std::vector<std::string> set;  ///< key=value
    std::optional<double> seconds;
    std::optional<long> steps;
    std::string out;    ///< folder; empty: print the summary only
    bool plan = false;  ///< print the passes and textures the scene calls for, and stop
};
int simulate(const SimulateOptions& options);

struct BenchOptions {
    std::string scene;  ///< empty: "bench", or "everything" for its effects
    std::vector<std::string> set;
    std::vector<int> grids;  ///< cells along the longest side; empty: six, or for effects the scene's own
    int repeats = 30;
    std::string json;      ///< file; empty: none
    bool effects = false;  ///< what each effect of the scene costs, in place of stages and presets
    bool csv = false;      ///< of effects: lines of CSV on standard output in place of tables
    std::string plot;      ///< of effects: PNG file; empty: none
    std::string paper;     ///< folder for the figures of the 2009 paper in place of tables; empty: none
};
int bench(const BenchOptions& options);
int bench_effects(const BenchOptions& options);
int bench_paper(const BenchOptions& options);

struct AccuracyOptions {
    bool validate = false;           ///< run cases with known answers
    bool list = false;               ///< say which there are, and stop
    bool full = false;               ///< on the grids of a full validation
    std::vector<std::string> cases;  ///< names or families; empty: all
    std::vector<int> grids;          ///< cells along the longest side; empty: each case's own
    std::vector<std::string> set;    ///< key=value, after what the case itself sets
    std::string json;                ///< file; empty: none
    bool csv = false;                ///< lines of CSV on standard output in place of tables
    bool sweep = false;  ///< hold errors against time, over every knob; with full, cases and grids
    std::string shard;   ///< "3/8": only that part of the sweep; empty: all of it
    std::vector<std::string> merge;  ///< folders of all parts of a sweep, to be put together
    std::string out;                 ///< folder for a sweep
};
/// 1 too if a limit was missed.
int validate(const AccuracyOptions& options);
int sweep_accuracy(const AccuracyOptions& options);
int merge_sweeps(const std::vector<std::string>& folders, const std::string& out);

struct StabilityOptions {
    bool list = false;               ///< say which cases there are, and stop
    bool quick = false;              ///< few steps on a small grid
    bool full = false;               ///< everything
    std::vector<std::string> cases;  ///< names or numbers, "a+b" for two at once; empty: all
    std::vector<std::string> grids;  ///< as 25 or 33x47x29; empty: those of quick, full or neither
    std::string shard;               ///< "3/8": only that part; empty: all of it
    bool resume = false;             ///< go on where the CSV in `out` ends
    std::vector<std::string> merge;  ///< folders of all parts, to be put together
    std::string out;                 ///< folder for CSV, report and picture; empty: none
    std::optional<int> fuzz;         ///< in place of the cases: so many random scenes
    std::optional<int> hands;        ///< in place of the cases: so many random hands
    std::uint64_t seed = 1;          ///< of the first of these or those
    std::optional<long> endless;     ///< in place of the cases: a scene for so many steps
    std::string scene;               ///< for that, and for hands: shipped scene or file; empty: "stir"
    std::vector<std::string> set;    ///< "key=value" over its file
};
/// 1 too if a cell is red.
int test_stability(const StabilityOptions& options);
/// 1 too if a scene broke the rule.
int fuzz_scenes(const StabilityOptions& options);
/// 1 too if a hand was given what it must not be given.
int fuzz_hands(const StabilityOptions& options);
/// 1 too if something drifts.
int run_endlessly(const StabilityOptions& options);

struct HapticsOptions {
    std::vector<std::string> scenes;  ///< shipped, or files; empty: stir and jet
    int cells = 24;                   ///< along the longest side of their tanks
    bool quick = false;               ///< no scenes
    std::string out;                  ///< folder for CSV, report and pictures; empty: none
};
int study_haptics(const HapticsOptions& options);

enum class ClockChoice { Real, Stepped };

struct RunOptions {
    std::string config = kConfigFolder;  ///< folder of the exhibit's settings
    std::string scene;                   ///< empty: what the exhibit's configuration says
    std::vector<std::string> set;
    std::optional<DisplayChoice> display;
    std::optional<HapticsChoice> haptics;
    std::optional<OverlayChoice> overlay;
    std::vector<SolverPreset> presets;  ///< empty: those of the exhibit
    std::optional<double> preset_s;
    std::string motion;                  ///< CSV for the emulated hand; empty: a person-like motion
    std::string motion_axes = "x,z,-y";  ///< which way the recording's axes point
    std::uint64_t seed = 1;
    std::optional<double> seconds;  ///< none: until told to stop
    std::string record;             ///< folder for pictures and force.csv
    double frames_per_s = 10.0;     ///< pictures recorded per second
    ClockChoice clock = ClockChoice::Real;
    std::string run_dir;    ///< where status.json goes; empty: from the configuration, if writable
    std::string state_dir;  ///< where tunings are kept; empty: from the configuration, if it is there
};
int run(const RunOptions& options);

struct TuneOptions {
    std::string config = kConfigFolder;  ///< folder of the exhibit's settings
    std::string scene;                   ///< empty: what the exhibit's configuration says
    std::vector<std::string> set;
    std::string state_dir;  ///< where the result is kept; empty: from the configuration; made if need be
    bool show = false;      ///< print what is stored, and stop
};
/// 1 too if not even the cheapest setting keeps the rate.
int tune(const TuneOptions& options);

struct FalconOptions {
    std::string config = kConfigFolder;   ///< folder of the exhibit's settings
    std::optional<std::string> firmware;  ///< in place of the exhibit's
    std::optional<std::string> serial;
    double seconds = 5.0;     ///< how long to look at it once it is found and loaded
    double weight_g = 100.0;  ///< of a calibration
};
/// 1 too if no Falcon was ready or homing in the end.
int diagnose_falcon(const FalconOptions& options);
/// 1 too if it did not succeed.
int calibrate_falcon(const FalconOptions& options);

struct ScreenOptions {
    std::string config = kConfigFolder;    ///< folder of the exhibit's settings
    std::optional<std::string> connector;  ///< in place of the exhibit's
    std::optional<std::string> mode;
};
/// 1 too if no screen can be driven now.
int diagnose_screen(const ScreenOptions& options);

struct PanelOptions {
    std::string config = kConfigFolder;  ///< folder of the exhibit's settings
    std::optional<LampCode> code;  ///< show it, in place of one lamp after the other
    double seconds = 10.0;         ///< how long to look
    bool codes = false;            ///< print what each means, and stop
};
/// 1 too if a line that is configured cannot be had.
int diagnose_panel(const PanelOptions& options);

struct ReplayOptions {
    std::string flight;  ///< file
    std::string plot;    ///< PNG file; empty: none
};
/// 1 too if the rerun differs.
int replay(const ReplayOptions& options);

struct RtSelftestOptions {
    std::string config = kConfigFolder;  ///< folder of the exhibit's settings
    double seconds = 10.0;
    std::optional<HapticsChoice> haptics;
    std::string plot;  ///< PNG file; empty: none
};
/// 1 too if the loop is not even enough.
int rt_selftest(const RtSelftestOptions& options);

int check_config(const std::string& file);
/// Settings, the scene they name and what that names.
int check_config_folder(const std::string& folder);
int print_config(const std::string& folder, const std::string& scene, const std::vector<std::string>& set,
                 bool origin);
/// The reference of scene files as markdown (docs/scene.md).
int print_schema();
/// Of the exhibit's settings (the end of docs/config.md).
int print_exhibit_keys();
/// The same for editors (docs/exhibit.schema.json).
int print_exhibit_schema();
/// The kinds of lines in the log as markdown (docs/log.md).
int print_log_reference();

}  // namespace eddy
