#include "firmware/accuracy/sweep/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "firmware/accuracy/sweep/problem.h"
#include "firmware/input_error.h"

namespace eddy::accuracy::sweep {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Spread& s) {
    return {{"p50", s.p50}, {"p95", s.p95}};
}

Spread spread_from(const Json& j) {
    return {j.at("p50"), j.at("p95")};
}

/// JSON has no nan: an error that is not a number becomes null.
Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json to_json(const Measurement& m) {
    const Setting& s = m.point.setting;
    Json j{{"index", m.index},
           {"case", m.point.problem},
           {"method", to_word(s.method)},
           {"cells", s.cells},
           {"iterations", s.iterations},
           {"dt_factor", s.dt_factor},
           {"force", word_of(s.force)},
           {"dt_s", m.dt_s},
           {"error", number(m.error)},
           {"repeats", m.repeats},
           {"wall_ms", to_json(m.wall_ms)},
           {"cpu_ms", to_json(m.cpu_ms)}};
    if (m.gpu_ms) j["gpu_ms"] = to_json(*m.gpu_ms);
    for (const auto& [stage, ms] : m.stages) j["stages_wall_ms"][stage] = ms;
    return j;
}

Measurement measurement_from(const Json& j) {
    Measurement m;
    m.index = j.at("index");
    m.point.problem = j.at("case");
    m.point.setting = {preset_named(j.at("method")), j.at("cells"), j.at("iterations"), j.at("dt_factor"),
                       force_way(j.at("force"))};
    m.dt_s = j.at("dt_s");
    m.error = j.at("error").is_null() ? std::nan("") : j.at("error").get<double>();
    m.repeats = j.at("repeats");
    m.wall_ms = spread_from(j.at("wall_ms"));
    m.cpu_ms = spread_from(j.at("cpu_ms"));
    if (j.contains("gpu_ms")) m.gpu_ms = spread_from(j.at("gpu_ms"));
    if (j.contains("stages_wall_ms"))
        for (const auto& [stage, ms] : j.at("stages_wall_ms").items()) m.stages.emplace_back(stage, ms);
    return m;
}

std::string shown(const Point& point) {
    return fmt::format("{} {}", point.problem, describe(point.setting));
}

}  // namespace

Chosen points_of(const Table& table, const std::string& problem) {
    return chosen(table.measured, [&](const Measurement& m) {
        return m.point.problem == problem && m.point.setting.force == ForceWay::Surface;
    });
}

std::string csv_of(const Table& table) {
    std::string text =
        "case,method,cells,iterations,dt_factor,force,dt_s,error,error_over_hand,repeats,wall_ms_p50,wall_ms_"
        "p95,"
        "cpu_ms_p50,cpu_ms_p95,gpu_ms_p50,gpu_ms_p95\n";
    for (const Measurement& m : table.measured) {
        const Setting& s = m.point.setting;
        const double hand = problem_named(m.point.problem).hand;
        text += fmt::format("{},{},{},{},{},{},{:.9g},{:.6g},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{}\n",
                            m.point.problem, to_word(s.method), s.cells, s.iterations, s.dt_factor,
                            word_of(s.force), m.dt_s, m.error,
                            hand > 0.0 ? fmt::format("{:.4g}", m.error / hand) : "", m.repeats, m.wall_ms.p50,
                            m.wall_ms.p95, m.cpu_ms.p50, m.cpu_ms.p95,
                            m.gpu_ms ? fmt::format("{:.4g},{:.4g}", m.gpu_ms->p50, m.gpu_ms->p95) : ",");
    }
    return text;
}

std::string json_of(const Table& table) {
    Json j{{"eddy_version", table.version}, {"renderer", table.renderer}, {"machines", table.machines},
           {"full", table.order.full},      {"cases", table.order.cases}, {"grids", table.order.grids},
           {"points", table.points},        {"measured", Json::array()}};
    for (const Measurement& m : table.measured) j["measured"].push_back(to_json(m));
    return j.dump(1) + "\n";
}

Table table_from_json(const std::string& text, const std::filesystem::path& file) {
    try {
        const Json j = Json::parse(text);
        Table table{j.at("eddy_version"),
                    j.at("renderer"),
                    j.at("machines"),
                    {j.at("full"), j.at("cases"), j.at("grids")},
                    j.at("points")};
        for (const Json& one : j.at("measured")) table.measured.push_back(measurement_from(one));
        for (const Measurement& m : table.measured)
            if (m.index >= table.points)
                throw std::out_of_range(fmt::format("point {} of {}", m.index + 1, table.points));
        return table;
    } catch (const std::exception& e) {  // a JSON error, or a word or number that is none
        throw InputError(
            fmt::format("{}: is not what eddy accuracy --sweep writes: {}", file.string(), e.what()));
    }
}

Table merged(std::span<const Table> shards, std::span<const std::string> names) {
    Table all = shards.front();
    all.machines.clear();
    all.measured.clear();
    std::vector<std::string> found_in(all.points);
    for (std::size_t i = 0; i < shards.size(); ++i) {
        const Table& shard = shards[i];
        const auto differs = [&](const char* what, const std::string& here, const std::string& there) {
            return InputError(fmt::format("--merge: {} has {} {}, {} has {}: only one sweep can be merged",
                                          names[0], what, here, names[i], there));
        };
        if (shard.version != all.version) throw differs("version", all.version, shard.version);
        if (shard.renderer != all.renderer) throw differs("renderer", all.renderer, shard.renderer);
        if (shard.order != all.order || shard.points != all.points)
            throw InputError(
                fmt::format("--merge: {} and {} are parts of different sweeps: give --full, --case and "
                            "--grid alike to all parts",
                            names[0], names[i]));
        for (const std::string& machine : shard.machines)
            if (std::find(all.machines.begin(), all.machines.end(), machine) == all.machines.end())
                all.machines.push_back(machine);
        for (const Measurement& m : shard.measured) {
            std::string& found = found_in.at(m.index);
            if (!found.empty())
                throw InputError(
                    fmt::format("--merge: {} and {} both hold {}", found, names[i], shown(m.point)));
            found = names[i];
            all.measured.push_back(m);
        }
    }
    if (const auto missing = std::count(found_in.begin(), found_in.end(), ""); missing > 0)
        throw InputError(fmt::format(
            "--merge: {} of {} points are in none of these, the first of them number {}: "
            "give all parts",
            missing, all.points, std::find(found_in.begin(), found_in.end(), "") - found_in.begin() + 1));
    std::sort(all.measured.begin(), all.measured.end(),
              [](const Measurement& a, const Measurement& b) { return a.index < b.index; });
    return all;
}

}  // namespace eddy::accuracy::sweep
