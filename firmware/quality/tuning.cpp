#include "firmware/quality/tuning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "firmware/input_error.h"
#include "firmware/text_file.h"

namespace eddy {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Rung& rung) {
    return {{"preset", to_word(rung.quality.preset)}, {"cells", rung.quality.cells},
            {"iterations", rung.quality.iterations},  {"step_ms_p50", rung.step_ms},
            {"step_ms_p95", rung.step_ms_p95},        {"force_error", rung.force_error}};
}

Rung rung_of(const Json& j) {
    Rung rung{{preset_named(j.at("preset")), j.at("cells"), j.at("iterations")},
              j.at("step_ms_p50"),
              j.at("step_ms_p95"),
              std::numeric_limits<double>::quiet_NaN()};
    if (const Json& error = j.at("force_error"); !error.is_null()) rung.force_error = error;
    if (rung.quality.cells < 1 || rung.quality.iterations < 1 || !(rung.step_ms > 0.0))
        throw std::invalid_argument("a rung that cannot be");
    return rung;
}

}  // namespace

void choose(Tuning& tuning) {
    std::vector<Rung> sorted;
    for (const Rung& rung : tuning.measured)
        if (std::isfinite(rung.force_error)) sorted.push_back(rung);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Rung& a, const Rung& b) { return a.step_ms < b.step_ms; });
    tuning.ladder.clear();
    tuning.chosen = 0;
    for (const Rung& rung : sorted)
        if (tuning.ladder.empty() || (rung.force_error < tuning.ladder.back().force_error &&
                                      rung.step_ms > tuning.ladder.back().step_ms))
            tuning.ladder.push_back(rung);
    for (std::size_t i = 0; i < tuning.ladder.size(); ++i)
        if (tuning.ladder[i].step_ms_p95 <= kTuningMargin * tuning.budget_ms) tuning.chosen = i;
}

std::string to_json(const Tuning& t) {
    Json j{{"eddy_version", t.version}, {"renderer", t.renderer},   {"machine", t.machine},
           {"made_at", t.made_at},      {"target_hz", t.target_hz}, {"picture_ms", t.picture_ms},
           {"budget_ms", t.budget_ms},  {"chosen", t.chosen}};
    for (const Rung& rung : t.ladder) j["ladder"].push_back(json_of(rung));
    for (const Rung& rung : t.measured) j["measured"].push_back(json_of(rung));
    j["scene"] = t.scene;
    return j.dump(2) + "\n";
}

Tuning tuning_from_json(const std::string& text, const std::filesystem::path& file) {
    try {
        const Json j = Json::parse(text);
        Tuning t{j.at("eddy_version"), j.at("renderer"),  j.at("machine"),    j.at("made_at"),
                 j.at("scene"),        j.at("target_hz"), j.at("picture_ms"), j.at("budget_ms")};
        for (const Json& rung : j.at("measured")) t.measured.push_back(rung_of(rung));
        for (const Json& rung : j.at("ladder")) t.ladder.push_back(rung_of(rung));
        for (std::size_t i = 1; i < t.ladder.size(); ++i)
            if (!(t.ladder[i].step_ms > t.ladder[i - 1].step_ms))
                throw std::invalid_argument("the ladder is not cheapest first");
        t.chosen = j.at("chosen");
        if (t.chosen >= t.ladder.size()) throw std::invalid_argument("chosen is not in the ladder");
        return t;
    } catch (const std::exception& e) {  // of the library, or a word that is none
        throw InputError(fmt::format("{}: is not what eddy tune writes: {}", file.string(), e.what()));
    }
}

std::filesystem::path tuning_file(const std::filesystem::path& state_dir, const std::string& scene) {
    std::string name = is_scene_file(scene) ? std::filesystem::path(scene).stem().string() : scene;
    const auto stays = [](unsigned char c) { return c >= 0x80 || std::isalnum(c) || c == '_' || c == '.'; };
    for (char& c : name)
        if (!stays(static_cast<unsigned char>(c))) c = '-';
    return state_dir / fmt::format("tuning-{}.json", name);
}

std::optional<Tuning> stored_tuning(const std::filesystem::path& file, const Scene& scene,
                                    const std::string& renderer, std::string& trouble) {
    std::error_code none;
    if (!std::filesystem::exists(file, none)) {
        trouble = fmt::format("{} does not exist", file.string());
        return std::nullopt;
    }
    try {
        Tuning tuning = tuning_from_json(read_text_file(file), file);
        if (tuning.version != EDDY_VERSION)
            trouble = fmt::format("{} is of version {}", file.string(), tuning.version);
        else if (tuning.renderer != renderer)
            trouble = fmt::format("{} is of another renderer, {}", file.string(), tuning.renderer);
        else if (tuning.scene != print_scene(scene))
            trouble = fmt::format("{} is of another scene", file.string());
        else
            return tuning;
    } catch (const std::runtime_error& e) {
        trouble = e.what();
    }
    return std::nullopt;
}

}  // namespace eddy
