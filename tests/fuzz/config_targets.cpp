#include "tests/fuzz/config_targets.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "config/exhibit.h"
#include "config/scene.h"

namespace eddy {
namespace {

/// An assertion that also holds in a release build.
void demand(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "fuzz: not so: %s\n", what);
    std::abort();
}

void demand_places(const std::vector<Diagnostic>& diagnostics, std::string_view text) {
    const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
    for (const Diagnostic& d : diagnostics) {
        demand(!d.message.empty(), "a mistake has words");
        demand(d.line >= 0 && d.line <= lines + 1, "a mistake is in the file");
        demand(to_string(d).find('\n') == std::string::npos, "a mistake is told in one line");
    }
}

ExhibitFiles layers_of(std::string_view text) {
    constexpr std::string_view kParting = "\n%%\n";
    ExhibitFiles files;
    files.folder = "/e";
    for (int i = 0; i < 8; ++i) {
        const std::size_t end = text.find(kParting);
        const std::string layer(text.substr(0, end));
        if (i == 0)
            files.own.push_back({"/e/exhibit.toml", layer});
        else
            files.drop_ins.push_back({"/e/conf.d/" + std::to_string(i) + ".toml", layer});
        if (end == std::string_view::npos) break;
        text.remove_prefix(end + kParting.size());
    }
    return files;
}

}  // namespace

void fuzz_exhibit(std::span<const std::uint8_t> input) {
    const std::string text(input.begin(), input.end());
    const ExhibitFiles files = layers_of(text);
    const ExhibitReading reading = read_exhibit(files);
    demand_places(reading.diagnostics, text);
    if (!reading.diagnostics.empty()) return;
    const Exhibit& exhibit = reading.loaded.exhibit;
    ExhibitFiles own = files;
    own.drop_ins.clear();
    demand(exhibit.max_force_n <= read_exhibit(own).loaded.exhibit.max_force_n, "conf.d raises no ceiling");
    ExhibitFiles again;
    again.folder = "/e";
    again.own.push_back({"/e/exhibit.toml", print_exhibit(exhibit)});
    const ExhibitReading printed = read_exhibit(again);
    demand(printed.diagnostics.empty() && printed.loaded.exhibit == exhibit, "settings read back as printed");
    demand(changed_keys(exhibit, printed.loaded.exhibit).empty(), "what is the same has no changes");
    const Exhibit held = without_restart(Exhibit{}, exhibit);
    for (const KeyChange& change : changed_keys(Exhibit{}, held))
        demand(change.takes_effect <= TakesEffect::Scene, "what needs a restart is not applied");
}

void fuzz_scene(std::span<const std::uint8_t> input) {
    const std::string text(input.begin(), input.end());
    try {
        const Scene scene = read_scene(text, "/e/s.toml").scene;
        demand(read_scene(print_scene(scene), "/e/s.toml").scene == scene, "a scene reads back as printed");
    } catch (const ConfigError& error) {
        demand(!error.diagnostics().empty(), "a refusal says why");
        demand_places(error.diagnostics(), text);
    }
}

}  // namespace eddy
