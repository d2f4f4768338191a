#include "firmware/stability/long_run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "firmware/input_error.h"

namespace eddy::stability {
namespace {

constexpr const char* kHead =
    "run,steps,mean_pressure_pa,pressure_scale_pa,smoke_m3,kinetic_energy_j,mean_force_n,mean_sent_n,memory_"
    "mib,textures_mib,"
    "textures_made,programs,framebuffers\n";

/// Samples of a run in the report.
constexpr std::size_t kShown = 6;

LongRunSample sample_from(std::istringstream& fields) {
    std::array<double, 12> v{};
    std::string field;
    for (double& value : v) {
        std::getline(fields, field, ',');
        value = std::stod(field);
    }
    const auto count = [&](std::size_t i) { return static_cast<std::size_t>(v[i]); };
    return {static_cast<long>(v[0]),
            v[1],
            v[2],
            v[3],
            v[4],
            v[5],
            v[6],
            v[7],
            v[8],
            count(9),
            count(10),
            count(11)};
}

std::size_t objects(const LongRunSample& s) {
    return s.textures_made + s.programs + s.framebuffers;
}

}  // namespace

std::string table_of(std::span<const LongRunSample> samples) {
    std::string text = fmt::format("{:>10}{:>14}{:>12}{:>14}{:>14}{:>12}{:>13}{:>14}{:>10}\n", "steps",
                                   "mean p [Pa]", "smoke [m3]", "energy [J]", "force [N]", "sent [N]",
                                   "memory [MiB]", "textures [MiB]", "objects");
    for (const LongRunSample& s : samples)
        text += fmt::format("{:>10}{:>14.3g}{:>12.4g}{:>14.3g}{:>14.3g}{:>12.4g}{:>13.2f}{:>14.2f}{:>10}\n",
                            s.steps, s.pressure_mean_pa, s.smoke_total_m3, s.kinetic_energy_j, s.force_mean_n,
                            s.sent_mean_n, s.memory_mib, s.texture_mib, objects(s));
    return text;
}

std::string csv_of(std::span<const LongRun> runs) {
    std::string text = kHead;
    for (const LongRun& run : runs)
        for (const LongRunSample& s : run.samples)
            text +=
                fmt::format("\"{}\",{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.2f},{:.2f},{},{},{}\n",
                            run.what, s.steps, s.pressure_mean_pa, s.pressure_scale_pa, s.smoke_total_m3,
                            s.kinetic_energy_j, s.force_mean_n, s.sent_mean_n, s.memory_mib, s.texture_mib,
                            s.textures_made, s.programs, s.framebuffers);
    return text;
}

std::vector<LongRun> long_runs_from_csv(const std::string& text, const std::filesystem::path& file) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    if (line + "\n" != kHead)
        throw InputError(fmt::format("{}: is not what eddy stability --endless writes", file.string()));
    std::vector<LongRun> runs;
    for (int number = 2; std::getline(lines, line); ++number) {
        const std::size_t end = line.rfind("\",");
        try {
            std::istringstream fields(line.substr(std::min(line.size(), end + 2)));
            const LongRunSample sample = sample_from(fields);
            const std::string what = line.substr(1, end - 1);
            if (runs.empty() || runs.back().what != what) runs.push_back({what, {}});
            runs.back().samples.push_back(sample);
        } catch (const std::logic_error&) {  // a field that is missing, or a number that is none
            throw InputError(
                fmt::format("{}:{}: is not what eddy stability --endless writes", file.string(), number));
        }
    }
    return runs;
}

std::string report_of(std::span<const LongRun> runs) {
    std::string text =
        "\n## Runs without an end\n\nCase 21. The exhibit on virtual time (`eddy stability --endless`): the "
        "show, the "
        "1 kHz loop and its law. Forces are means over two minutes of the scene, all else is as it was then; "
        "memory is that of the whole program, objects are textures made, programs and framebuffers.\n";
    for (const LongRun& run : runs) {
        text += fmt::format("\n{}:\n\n", run.what);
        text +=
            "| steps | mean pressure [Pa] | smoke [m3] | energy [J] | force [N] | sent [N] | memory [MiB] | "
            "textures [MiB] | objects |\n|---|---|---|---|---|---|---|---|---|\n";
        const std::size_t samples = run.samples.size(), shown = std::min(kShown, samples);
        for (std::size_t n = 0; n < shown; ++n) {
            const LongRunSample& s = run.samples[shown > 1 ? n * (samples - 1) / (shown - 1) : 0];
            text +=
                fmt::format("| {} | {:.3g} | {:.4g} | {:.3g} | {:.4g} | {:.4g} | {:.1f} | {:.2f} | {} |\n",
                            s.steps, s.pressure_mean_pa, s.smoke_total_m3, s.kinetic_energy_j, s.force_mean_n,
                            s.sent_mean_n, s.memory_mib, s.texture_mib, objects(s));
        }
        const std::vector<std::string> drifted = drifts(run.samples);
        text += drifted.empty() ? "\nNothing drifts.\n" : "\nDrifts:\n\n";
        for (const std::string& drift : drifted) text += "- " + drift + "\n";
    }
    return text;
}

}  // namespace eddy::stability
