#include "firmware/stability_options.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "firmware/command_line.h"

namespace eddy {

void add_stability(CLI::App& app, StabilityOptions& stability) {
    auto* verb = app.add_subcommand(
        "stability",
        "Hard cases: what a hand, a file or a driver can do to the fluid, and whether it stands it");
    verb->option_defaults()->take_last();
    verb->add_flag("--list", stability.list, "list the cases: what each provokes, and what it wants");
    auto* quick = verb->add_flag("--quick", stability.quick,
                                 "of each as many steps on 8^3 cells as it takes to happen (three minutes)");
    auto* full = verb->add_flag(
        "--full", stability.full,
        "on four grids up to 64^3, the longest runs and every pair of cases as well (a day in software)");
    quick->excludes(full);
    verb->add_option("--case", stability.cases,
                     "only these: names or numbers, as 4,piston; two at once: stall+cup")
        ->delimiter(',')
        ->take_all();
    verb->add_option("--grid", stability.grids,
                     "on these grids, as 8,25 or 33x47x29 [8,25]; with --full, of its grids these")
        ->delimiter(',')
        ->take_all();
    auto* shard = verb->add_option("--shard", stability.shard,
                                   "only part I of N: give each machine its own part and --out, then --merge")
                      ->type_name("I/N");
    auto* resume =
        verb->add_flag("--resume", stability.resume, "go on where the stability.csv in --out ends");
    auto* merge = verb->add_option("--merge", stability.merge,
                                   "put the parts of a matrix together: the folders they were written to")
                      ->type_name("FOLDER...")
                      ->take_all()
                      ->expected(1, 100000);
    auto* out = verb->add_option("--out", stability.out, "folder for stability.csv, report.md, heat_map.png");
    resume->needs(out);
    merge->needs(out);
    merge->excludes(shard)->excludes(resume);
    verb->add_option("--fuzz", stability.fuzz,
                     "in place of the cases: so many scenes that chance makes, 200 steps each; those that "
                     "break the rule are made as small as they get and written to --out")
        ->check(CLI::Range(1, 1000000));
    verb->add_option("--hands", stability.hands,
                     "in place of the cases: so many hands that chance moves (leaps, nan, silence, bursts), "
                     "four seconds each at 1 kHz; whether any gets a force that it must not get")
        ->check(CLI::Range(1, 1000000));
    verb->add_option("--seed", stability.seed,
                     "of the first random scene or hand; each has a seed of its own [1]");
    verb->add_option("--endless", stability.endless,
                     "in place of the cases: a scene for so many steps, alone and with somebody who stirs; "
                     "whether memory, smoke or force drift; figures go to --out as well")
        ->check(CLI::Range(1L, 1000000000L));
    verb->add_option("--scene", stability.scene,
                     "for --hands and --endless: shipped scene or file [stir; for hands on 8^3 cells]");
    add_set(*verb, stability.set);
    verb->footer(
        "  eddy stability --quick                             what holds on this machine, in three "
        "minutes\n"
        "  eddy stability --case stall+cup --grid 25          two cases at once\n"
        "  eddy stability --fuzz 1000 --seed 1 --out fuzz     random scenes\n"
        "  eddy stability --hands 1 --seed 7                  one random hand again\n"
        "  eddy stability --endless 100000 --set tank.cells=[16,16,16]\n"
        "Exit status 1 if a cell is red, a scene or a hand breaks the rule or something drifts.");
}

void check_stability(const CLI::App& verb) {
    const auto given = [&](const std::string& option) { return verb.get_option(option)->count() > 0; };
    struct Way {
        const char* option;
        std::vector<std::string> takes;
    };
    const std::vector<Way> ways{
        {"--fuzz", {"--seed", "--out"}},
        {"--hands", {"--seed", "--scene", "--set"}},
        {"--endless", {"--scene", "--set", "--out"}},
        {nullptr,
         {"--list", "--quick", "--full", "--case", "--grid", "--shard", "--resume", "--merge", "--out"}}};
    const Way& chosen = *std::find_if(ways.begin(), ways.end(),
                                      [&](const Way& way) { return !way.option || given(way.option); });
    for (const Way& way : ways) {
        if (way.option && way.option != chosen.option && given(way.option))
            throw InputError(fmt::format("{} and {}: one at a time", chosen.option, way.option));
        for (const std::string& option : way.takes) {
            const auto takes = [&](const Way& one) {
                return std::find(one.takes.begin(), one.takes.end(), option) != one.takes.end();
            };
            if (!given(option) || takes(chosen)) continue;
            if (chosen.option)
                throw InputError(fmt::format("{} does not go with {}, which takes {}", option, chosen.option,
                                             fmt::join(chosen.takes, ", ")));
            std::vector<std::string> takers;
            for (const Way& one : ways)
                if (takes(one)) takers.emplace_back(one.option);
            throw InputError(fmt::format("{} goes with {} only", option, fmt::join(takers, " or ")));
        }
    }
}

}  // namespace eddy
