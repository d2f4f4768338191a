#include <nlohmann/json.hpp>

#include "firmware/effects/report.h"
#include "firmware/machine.h"

namespace eddy::effects {
namespace {

nlohmann::ordered_json json_of(const Timings& times) {
    nlohmann::ordered_json j;
    for (const CostClock clock : {CostClock::Cpu, CostClock::Wall, CostClock::Gpu}) {
        const std::vector<double>& ms = by(clock, times);
        if (!ms.empty())
            j[to_string(clock)] = {
                {"ms_p50", median(ms)}, {"ms_p95", percentile_95(ms)}, {"repeats", ms.size()}};
    }
    return j;
}

nlohmann::ordered_json json_of(const StepCost& cost) {
    return {{"passes", cost.work.passes},         {"uniforms", cost.work.uniforms},
            {"texels", cost.work.texels},         {"bytes_written", cost.work.bytes},
            {"fetches", cost.work.fetches},       {"textures", cost.textures},
            {"texture_bytes", cost.texture_bytes}};
}

nlohmann::ordered_json json_of(const EffectCosts& m, const EffectAdded& added) {
    nlohmann::ordered_json j{{"with", m.study.variants[added.with].name},
                             {"without", m.study.variants[added.without].name}};
    for (const CostClock clock : {CostClock::Cpu, CostClock::Wall, CostClock::Gpu}) {
        const std::vector<double> ms = added_ms(m, added, clock);
        if (!ms.empty())
            j["added_ms"][to_string(clock)] = {
                {"p25", percentile(ms, 25)}, {"p50", median(ms)}, {"p75", percentile(ms, 75)}};
    }
    return j;
}

}  // namespace

std::string json_of(const EffectCosts& m, const gles::Capabilities& driver) {
    const Scene& scene = m.study.variants[0].scene;
    const glm::ivec3& n = scene.tank.cells;
    nlohmann::ordered_json j{{"eddy_version", EDDY_VERSION}, {"scene", scene.title},
                             {"cells", {n.x, n.y, n.z}},     {"renderer", driver.renderer},
                             {"gl_version", driver.version}, {"machine", describe_machine()},
                             {"clock", to_string(m.clock)}};
    for (std::size_t v = 0; v < m.variants.size(); ++v)
        j["variants"].push_back({{"name", m.study.variants[v].name},
                                 {"effects", m.study.variants[v].effects},
                                 {"step", json_of(m.variants[v].cost)},
                                 {"times", json_of(m.variants[v].times)}});
    for (const EffectStudy::Row& row : m.study.rows)
        j["effects"].push_back({{"name", row.effect},
                                {"leaves_with_it", row.leaves_with_it},
                                {"added_to_whole", json_of(m, row.to_whole)},
                                {"added_to_bare", json_of(m, row.to_bare)}});
    j["all_but_the_bodies"] = json_of(m, m.study.all_but_bodies);
    return j.dump(2) + "\n";
}

}  // namespace eddy::effects
