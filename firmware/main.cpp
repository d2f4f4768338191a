#include <fmt/format.h>

#include "config/diagnostic.h"
#include "firmware/built_from.h"
#include "firmware/command_line.h"
#include "firmware/stability_options.h"
#include "firmware/verbs/verbs.h"
#include "hal/display/kms/choice.h"

// The command line. Exit status: 0 done, 1 failed, 2 wrong usage or bad input.

namespace eddy {
namespace {

constexpr double kShortestS = 1e-3, kLongestS = 1e9;  // of a run; 30 years, well inside 64 bits of ns

constexpr Word<ClockChoice> kClockChoices[] = {
    {ClockChoice::Real, "real", "the machine's"},
    {ClockChoice::Stepped, "stepped", "virtual time"},
};

constexpr auto kLampCodes = [] {
    std::array<Word<LampCode>, kLampRows.size()> words{};
    for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = {kLampRows[i].code, kLampRows[i].word, kLampRows[i].meaning};
    return words;
}();

struct CommandLine {
    CLI::App app{"Eddy lets people feel a fluid: 3D smoke on the screen, its force in the hand."};
    RunOptions run;
    SimulateOptions simulate;
    BenchOptions bench;
    TuneOptions tune;
    AccuracyOptions accuracy;
    StabilityOptions stability;
    FalconOptions falcon;
    HapticsOptions haptics;
    ScreenOptions screen;
    PanelOptions panel;
    ReplayOptions replay;
    RtSelftestOptions rt_selftest;
    CLI::App* calibrate = nullptr;
    std::string check_file, check_folder, print_scene, print_folder = kConfigFolder;
    std::vector<std::string> print_set;
    bool print_origin = false, print_keys = false, print_exhibit_keys = false, print_exhibit_schema = false,
         print_log = false;

    CommandLine() {
        app.set_version_flag("--version", fmt::format("eddy {} ({})", EDDY_VERSION, kBuiltFrom));
        app.require_subcommand(1);
        app.failure_message([](const CLI::App*, const CLI::Error& e) {
            return fmt::format("eddy: {}; eddy --help and eddy VERB --help say what can be written\n",
                               e.what());
        });
        app.footer(
            "eddy VERB --help says more about each. Exit status: 0 done, 1 failed, 2 wrong usage or bad "
            "input.");
        add_run();
        add_simulate();
        add_bench();
        add_accuracy();
        add_stability(app, stability);
        add_tune();
        add_falcon();
        add_haptics();
        add_screen();
        add_panel();
        add_replay();
        add_rt_selftest();
        auto* check = app.add_subcommand(
            "check-config",
            "Check a scene or exhibit file, or a whole folder of settings, without touching any device");
        check->add_option("FILE", check_file, "the file to check");
        add_config(*check, check_folder, "in place of FILE: check this folder of settings, scene and all");
        auto* print =
            app.add_subcommand("print-config", "Show the merged exhibit settings, or all keys of a scene");
        print->add_option("SCENE", print_scene,
                          "a scene (shipped name or file); without: the exhibit's settings");
        add_set(*print, print_set);
        print->add_flag("--origin", print_origin, "say for each value where it was written");
        print->add_flag("--log", print_log,
                        "print what the log may say, its ids and what to do (docs/log.md)");
        print->add_flag("--keys", print_keys,
                        "list every key a scene may have, with range, default and meaning");
        print->add_flag("--exhibit-keys", print_exhibit_keys,
                        "the same for the exhibit's settings, and when a new value takes effect");
        print->add_flag("--exhibit-schema", print_exhibit_schema, "the same as a JSON Schema, for editors");
        add_config(*print, print_folder);
    }

    void add_run() {
        auto* verb = app.add_subcommand(
            "run",
            "The exhibit: fluid, picture and force. Without options: the Novint Falcon if one is plugged\n"
            "in, else an emulated hand that moves like a person's; and the screen, if no desktop has it");
        verb->option_defaults()->take_last();  // script/run gives defaults that the user's options follow
        verb->add_option("--scene", run.scene, "shipped scene or file (print-config lists all keys)");
        add_set(*verb, run.set);
        add_config(*verb, run.config);
        choose(*verb->add_option("--display", run.display, "where the picture goes"),
               words_of(DisplayChoice{}));
        choose(*verb->add_option("--haptics", run.haptics, "what the hand holds"), words_of(HapticsChoice{}));
        choose(*verb->add_option("--overlay", run.overlay, "what is written over the picture"),
               words_of(OverlayChoice{}));
        choose(*verb->add_option("--presets", run.presets,
                                 "what the grip's right and left buttons step through, as fast,yang2009")
                    ->delimiter(',')
                    ->take_all(),
               words_of(SolverPreset{}));
        verb->add_option("--preset-s", run.preset_s, "they also change by themselves after so long; 0: never")
            ->check(number_from(0, 86400));
        verb->add_option("--motion", run.motion,
                         "recorded hand for the emulated Falcon: CSV t_s,x_m,y_m,z_m");
        verb->add_option("--motion-axes", run.motion_axes,
                         "device x right, y up, z to the person, in the recording's axes (for z up: x,z,-y)")
            ->capture_default_str();
        verb->add_option("--seed", run.seed, "of the emulated person")
            ->check(number_from(0, 1e18))
            ->capture_default_str();
        verb->add_option("--seconds", run.seconds, "stop after this long")
            ->check(number_from(kShortestS, kLongestS));
        verb->add_option("--record", run.record, "keep pictures, force.csv and motion.png in this folder");
        verb->add_option("--fps", run.frames_per_s, "pictures recorded per second")
            ->check(number_from(0.01, 1000.0))
            ->capture_default_str();
        choose(*verb->add_option("--clock", run.clock,
                                 "stepped: virtual time, the same run bit for bit each time"),
               std::span<const Word<ClockChoice>>(kClockChoices));
        verb->add_option("--run-dir", run.run_dir, "where status.json goes");
        verb->add_option(
            "--state-dir", run.state_dir,
            "where the scene's tuning is kept, as tuning-jet.json; if it is not there yet, it is made\n"
            "while nobody moves the hand");
    }

    void add_tune() {
        auto* verb = app.add_subcommand(
            "tune",
            "Measure this machine: grids and iterations for the scene's preset and rate, by time and by\n"
            "the error of the force. Keeps the result, with the evidence, for eddy run");
        verb->option_defaults()->take_last();
        verb->add_option("SCENE,--scene", tune.scene, "shipped scene or file [that of the exhibit]");
        add_set(*verb, tune.set);
        add_config(*verb, tune.config);
        verb->add_option("--state-dir", tune.state_dir,
                         "folder for the result, as tuning-jet.json [that of the exhibit]");
        verb->add_flag("--show", tune.show, "print what is kept there of this scene, and stop");
    }

    void add_falcon() {
        auto* verb = app.add_subcommand(
            "falcon",
            "Find the Novint Falcon, start it, and say how it is: state, rate, handle, buttons, troubles.\n"
            "No force. falcon calibrate finds its force scale with a known weight");
        verb->option_defaults()->take_last();
        verb->add_option("--firmware", falcon.firmware,
                         "firmware image for a cold device [falcon.firmware of the exhibit]");
        verb->add_option("--serial", falcon.serial, "the one with this serial string [falcon.serial]");
        add_config(*verb, falcon.config);
        verb->add_option("--seconds", falcon.seconds, "how long to look at it")
            ->check(number_from(0.1, 86400.0))
            ->capture_default_str();
        calibrate = verb->add_subcommand(
            "calibrate",
            "The motors hold the handle, empty and with a weight; prints falcon.motor_units_per_nm for\n"
            "conf.d of the exhibit's settings. The Falcon stands upright and nobody touches the handle; a "
            "minute");
        calibrate->add_option("--weight-g", falcon.weight_g, "mass of the weight")
            ->check(number_from(20.0, 400.0))
            ->capture_default_str();
    }

    void add_screen() {
        auto* verb = app.add_subcommand(
            "screen",
            "Graphics cards, plugs, monitors and modes; which would be used and why, or what is in the way.\n"
            "Changes nothing that is shown");
        verb->option_defaults()->take_last();
        verb->add_option("--connector", screen.connector,
                         "a plug, as HDMI-A-1 [screen.connector of the exhibit]");
        add_config(*verb, screen.config);
        verb->add_option("--mode", screen.mode, "a mode, as 1920x1080@60 [screen.mode]")
            ->check([](const std::string& text) {
                return text.empty() || kms::parse_mode(text) ? std::string()
                                                             : "write it like 1920x1080@60 or 1920x1080";
            });
    }

    void add_panel() {
        auto* verb = app.add_subcommand("panel",
                                        "Button, stop input and lamps: lists the machine's GPIO lines, says "
                                        "which are the panel's, lights\n"
                                        "its lamps one after the other, and tells what is pressed");
        verb->option_defaults()->take_last();
        auto* code = verb->add_option("--code", panel.code, "light the lamps as for this code instead");
        choose(*code, std::span<const Word<LampCode>>(kLampCodes));
        add_config(*verb, panel.config);
        verb->add_option("--seconds", panel.seconds, "how long to look")
            ->check(number_from(0.1, 86400.0))
            ->capture_default_str();
        verb->add_flag("--codes", panel.codes, "print what each code means and looks like, and stop")
            ->excludes(code);
        verb->footer("A running exhibit has the lines to itself: systemctl stop eddy first.");
    }

    void add_replay() {
        auto* verb = app.add_subcommand(
            "replay",
            "A flight recording, which eddy run keeps of the seconds before a fault: says what happened,\n"
            "and runs the law of the hand again on it, bit for bit, on any machine");
        verb->option_defaults()->take_last();
        verb->add_option("FLIGHT", replay.flight, "the recording: STATE-DIR/flights/*.flight")->required();
        verb->add_option("--plot", replay.plot, "draw force, handle and ages of data into this PNG");
        verb->footer(
            "  eddy replay /var/lib/eddy/flights/20261122T200000Z-device_silent.flight\n"
            "  eddy replay last.flight --plot last.png\n"
            "Exit status 1 if the rerun differs; it says from which tick on.");
    }

    void add_rt_selftest() {
        auto* verb = app.add_subcommand(
            "rt-selftest",
            "Whether this machine can keep the haptic loop at 1 kHz: how even its ticks are, how often the\n"
            "device answers, what the system grants, and how to make it grant more");
        verb->option_defaults()->take_last();
        verb->add_option("--seconds", rt_selftest.seconds, "how long to measure; a minute says more")
            ->check(number_from(1.0, 86400.0))
            ->capture_default_str();
        choose(*verb->add_option("--haptics", rt_selftest.haptics, "with which device [that of the exhibit]"),
               words_of(HapticsChoice{}));
        add_config(*verb, rt_selftest.config);
        verb->add_option("--plot", rt_selftest.plot, "draw how often each period came into this PNG");
        verb->footer(
            "  eddy rt-selftest --seconds 60 --plot periods.png   while the exhibit's other work goes on\n"
            "  eddy rt-selftest --haptics falcon                  the exchange with the real device\n"
            "Exit status 1 if a limit is missed: mean 1 ms within 1 %, one period in a thousand above\n"
            "1.5 ms, none above 5 ms, 950 exchanges a second.");
    }

    void add_simulate() {
        auto* verb = app.add_subcommand(
            "simulate", "Run any scene without display or hand; write series.csv, summary.json");
        verb->option_defaults()->take_last();
        verb->add_option("SCENE", simulate.scene, "shipped scene or file")->required();
        add_set(*verb, simulate.set);
        auto* seconds = verb->add_option("--seconds", simulate.seconds, "simulated time")
                            ->check(number_from(1e-9, kLongestS));
        verb->add_option("--steps", simulate.steps, "number of steps instead")
            ->check(CLI::PositiveNumber)
            ->excludes(seconds);
        verb->add_option("--out", simulate.out,
                         "folder for series.csv, summary.json and the fields the scene asks for");
        verb->add_flag("--plan", simulate.plan,
                       "print the passes and textures this scene calls for, and stop");
    }

    void add_bench() {
        auto* verb =
            app.add_subcommand("bench",
                               "Time per stage, for each preset and grid, beside the 2009 method; or with\n"
                               "--effects what each effect of a scene costs, with --paper the 2009 paper's\n"
                               "figures");
        verb->option_defaults()->take_last();
        verb->add_option("SCENE,--scene", bench.scene,
                         "shipped scene or file [bench, with --effects everything]");
        add_set(*verb, bench.set);
        verb->add_option("--grid", bench.grids,
                         "cells along the longest side of the tank, as 64 or 25,32,48\n"
                         "[25,32,48,64,96,128, with --effects the scene's own]")
            ->delimiter(',')
            ->take_all()
            ->check(CLI::Range(8, 512));
        auto* effects = verb->add_flag(
            "--effects", bench.effects,
            "time, passes and bytes of each effect of the scene (smoke, viscosity, force, ...):\n"
            "the whole scene, without each, each alone with the bodies, the bodies alone");
        verb->add_flag("--csv", bench.csv, "print lines of CSV instead of tables; with --effects")
            ->needs(effects);
        verb->add_option("--plot", bench.plot,
                         "also draw what the effects cost into this PNG; with --effects")
            ->needs(effects);
        verb->add_option("--paper", bench.paper,
                         "draw the 2009 paper's figures 8, 9, 10 and its Table I from this program's runs\n"
                         "into this folder: force added up on the GPU and on the CPU")
            ->excludes(effects);
        verb->add_option("--repeats", bench.repeats, "timed steps each")
            ->check(CLI::Range(1, 100000))
            ->capture_default_str();
        verb->add_option("--json", bench.json, "also write the figures to this file");
    }

    void add_accuracy() {
        auto* verb = app.add_subcommand(
            "accuracy", "Cases with known answers: how far off the solver is, at what order, at what cost");
        verb->option_defaults()->take_last();
        auto* validate = verb->add_flag("--validate", accuracy.validate,
                                        "run the cases; exit status 1 if a limit is missed");
        auto* list = verb->add_flag("--list", accuracy.list, "list the cases and their grids");
        verb->add_option("--case", accuracy.cases, "only these: a case or a family, as B2-shell or B2,B3")
            ->delimiter(',')
            ->take_all();
        auto* full = verb->add_flag("--full", accuracy.full,
                                    "on the grids of a full validation (some hours in software)");
        verb->add_option("--grid", accuracy.grids,
                         "on these grids: cells along the longest side of the tank, as 25,32,48")
            ->delimiter(',')
            ->take_all()
            ->check(CLI::Range(8, 512))
            ->excludes(full);
        add_set(*verb, accuracy.set);
        verb->add_option("--json", accuracy.json, "also write the figures to this file");
        verb->add_flag("--csv", accuracy.csv, "print lines of CSV instead of tables");
        auto* sweep = verb->add_flag(
            "--sweep", accuracy.sweep,
            "what accuracy costs: error and time per step over grids, time steps, methods and iterations, "
            "for the\n"
            "cases B2, B3, B8.7 and A1; tables and plots go to --out (some ten minutes; --full: a day)");
        verb->add_option(
                "--shard", accuracy.shard,
                "of a sweep, only part I of N: give each machine its own part and --out, then --merge")
            ->type_name("I/N")
            ->needs(sweep);
        auto* merge = verb->add_option("--merge", accuracy.merge,
                                       "put the parts of a sweep together: the folders they were written to")
                          ->type_name("FOLDER...")
                          ->take_all()
                          ->expected(1, 100000);
        auto* out = verb->add_option("--out", accuracy.out,
                                     "folder for accuracy.csv, accuracy.json, report.md, plots");
        sweep->needs(out);
        merge->needs(out);
        for (CLI::Option* other : {validate, list, verb->get_option("--set"), verb->get_option("--json"),
                                   verb->get_option("--csv")}) {
            sweep->excludes(other);
            merge->excludes(other);
        }
        merge->excludes(sweep);
        verb->footer(
            "The forces a hand feels, exact or fast:\n"
            "  eddy accuracy --sweep --out sweep                      all of it here\n"
            "  eddy accuracy --sweep --full --shard 3/8 --out part3   a part for a batch job\n"
            "  eddy accuracy --merge part1 part2 part3 --out sweep    tables and plots of all parts");
    }

    void add_haptics() {
        auto* verb = app.add_subcommand("haptics",
                                        "How the force of a fluid that answers 20 to 75 times a second feels "
                                        "at 1 kHz, by either law: roughness,\n"
                                        "delay, error, energy, and whether a handle that is held or let go "
                                        "comes to rest; on virtual time");
        verb->option_defaults()->take_last();
        verb->add_option("--scene", haptics.scenes,
                         "scenes with a body in the hand, as float [stir,jet]; the fluid of a known drag\n"
                         "and added mass is tried in any case")
            ->delimiter(',')
            ->take_all();
        verb->add_option("--grid", haptics.cells, "cells along the longest side of their tanks")
            ->check(CLI::Range(8, 512))
            ->capture_default_str();
        auto* quick = verb->add_flag("--quick", haptics.quick, "only the known fluid (seconds)");
        quick->excludes(verb->get_option("--scene"))->excludes(verb->get_option("--grid"));
        verb->add_option("--out", haptics.out, "folder for haptics.csv, report.md and pictures");
        verb->footer(
            "  eddy haptics --quick                        the laws alone, in a fluid that is known exactly\n"
            "  eddy haptics --scene jet --out jet          one scene (minutes in software; with free bodies, "
            "far more)\n"
            "  eddy haptics --grid 64 --out haptics                  what docs/haptics.md is made of\n"
            "The law of an exhibit is chosen by force = \"model\" or \"filter\" in its exhibit.toml.");
    }

    /// CLI11 would call an unknown verb a missing one.
    void require_verb(int argc, char** argv) const {
        if (argc < 2 || argv[1][0] == '-') return;
        std::string verbs;
        for (const CLI::App* verb : app.get_subcommands({})) {
            if (verb->get_name() == argv[1]) return;
            verbs += fmt::format("{}{}", verbs.empty() ? "" : ", ", verb->get_name());
        }
        throw InputError(fmt::format("eddy: there is no verb '{}'; there are {}", argv[1], verbs));
    }

    int act_on_accuracy() {
        if (!accuracy.merge.empty()) return merge_sweeps(accuracy.merge, accuracy.out);
        return accuracy.sweep ? sweep_accuracy(accuracy) : validate(accuracy);
    }

    int act_on_stability() {
        check_stability(*app.get_subcommand("stability"));
        if (stability.fuzz) return fuzz_scenes(stability);
        if (stability.hands) return fuzz_hands(stability);
        return stability.endless ? run_endlessly(stability) : test_stability(stability);
    }

    int act_on_falcon() {
        if (!calibrate->parsed()) return diagnose_falcon(falcon);
        if (app.get_subcommand("falcon")->get_option("--seconds")->count() > 0)
            throw InputError("--seconds does not go with calibrate, which ends when it has measured");
        return calibrate_falcon(falcon);
    }

    int act_on_check() {
        if (check_file.empty() == check_folder.empty())
            throw InputError("check-config: name a FILE, or a folder of settings with --config DIR");
        return check_file.empty() ? check_config_folder(check_folder) : check_config(check_file);
    }

    int act() {
        if (app.got_subcommand("run")) return eddy::run(run);
        if (app.got_subcommand("simulate")) return eddy::simulate(simulate);
        if (app.got_subcommand("bench")) {
            if (bench.effects) return bench_effects(bench);
            return bench.paper.empty() ? eddy::bench(bench) : bench_paper(bench);
        }
        if (app.got_subcommand("accuracy")) return act_on_accuracy();
        if (app.got_subcommand("stability")) return act_on_stability();
        if (app.got_subcommand("tune")) return eddy::tune(tune);
        if (app.got_subcommand("falcon")) return act_on_falcon();
        if (app.got_subcommand("screen")) return diagnose_screen(screen);
        if (app.got_subcommand("haptics")) return study_haptics(haptics);
        if (app.got_subcommand("panel")) return diagnose_panel(panel);
        if (app.got_subcommand("replay")) return eddy::replay(replay);
        if (app.got_subcommand("rt-selftest")) return eddy::rt_selftest(rt_selftest);
        if (app.got_subcommand("check-config")) return act_on_check();
        if (print_exhibit_keys) return eddy::print_exhibit_keys();
        if (print_exhibit_schema) return eddy::print_exhibit_schema();
        if (print_log) return print_log_reference();
        return print_keys ? print_schema() : print_config(print_folder, print_scene, print_set, print_origin);
    }
};

}  // namespace
}  // namespace eddy

int main(int argc, char** argv) {
    eddy::CommandLine line;
    try {
        line.require_verb(argc, argv);
        line.app.parse(argc, argv);
        return line.act();
    } catch (const CLI::ParseError& e) {
        return line.app.exit(e) == 0 ? 0 : 2;
    } catch (const eddy::ConfigError& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 2;
    } catch (const eddy::InputError& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 2;
    } catch (const std::exception& e) {
        fmt::print(stderr, "eddy: {}\n", e.what());
        return 1;
    }
}
