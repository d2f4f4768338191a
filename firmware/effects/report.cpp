#include "firmware/effects/report.h"

#include <fmt/format.h>

#include <algorithm>

namespace eddy::effects {
namespace {

template <class Number>
double mega(Number number) {
    return static_cast<double>(number) / 1e6;
}

std::size_t widest(const EffectStudy& study) {
    std::size_t width = 0;
    for (const SceneVariant& variant : study.variants) width = std::max(width, variant.name.size());
    return width;
}

std::vector<CostClock> clocks_of(const EffectCosts& m) {
    std::vector<CostClock> clocks{CostClock::Cpu, CostClock::Wall};
    if (!m.variants[0].times.gpu_ms.empty()) clocks.push_back(CostClock::Gpu);
    return clocks;
}

/// Five columns: what the effect adds.
std::string added_text(const EffectCosts& m, const EffectAdded& added) {
    const std::vector<double> ms = added_ms(m, added, m.clock);
    const StepCost &with = m.with(added).cost, &without = m.without(added).cost;
    return fmt::format("{:>9.2f} {:>16} {:>7} {:>8.2f} {:>7.2f}", median(ms),
                       fmt::format("{:.2f} .. {:.2f}", percentile(ms, 25), percentile(ms, 75)),
                       with.work.passes - without.work.passes, mega(with.work.fetches - without.work.fetches),
                       mega(with.texture_bytes) - mega(without.texture_bytes));
}

}  // namespace

std::string table_of_variants(const EffectCosts& m) {
    const std::size_t width = widest(m.study);
    std::string head, units;
    for (const CostClock clock : clocks_of(m)) {
        head += fmt::format("{:>18}", fmt::format("{} ms", to_string(clock)));
        units += fmt::format("{:>9}{:>9}", "p50", "p95");
    }
    std::string text =
        fmt::format("{:<{}}{}{:>8}{:>10}{:>12}{:>11}{:>12}\n{:<{}}{}{:>8}{:>10}{:>12}{:>11}{:>12}\n", "",
                    width, head, "passes", "uniforms", "fetches [M]", "written", "textures", "", width, units,
                    "", "", "", "[MB]", "[MB]");
    for (std::size_t v = 0; v < m.variants.size(); ++v) {
        const EffectCosts::Variant& variant = m.variants[v];
        text += fmt::format("{:<{}}", m.study.variants[v].name, width);
        for (const CostClock clock : clocks_of(m)) {
            const std::vector<double>& ms = by(clock, variant.times);
            text += fmt::format("{:>9.2f}{:>9.2f}", median(ms), percentile_95(ms));
        }
        const Work& work = variant.cost.work;
        text += fmt::format("{:>8}{:>10}{:>12.2f}{:>11.2f}{:>12.2f}\n", work.passes, work.uniforms,
                            mega(work.fetches), mega(work.bytes), mega(variant.cost.texture_bytes));
    }
    return text;
}

std::vector<const EffectStudy::Row*> costliest_first(const EffectCosts& m) {
    std::vector<const EffectStudy::Row*> rows;
    for (const EffectStudy::Row& row : m.study.rows) rows.push_back(&row);
    std::stable_sort(rows.begin(), rows.end(), [&](const auto* a, const auto* b) {
        return median(added_ms(m, a->to_whole, m.clock)) > median(added_ms(m, b->to_whole, m.clock));
    });
    return rows;
}

std::string table_of_effects(const EffectCosts& m) {
    constexpr int kWidth = 22;
    const std::string ms = fmt::format("{} ms", to_string(m.clock));
    const auto columns = [&](const char* first) {
        return fmt::format("{:>9} {:>16} {:>7} {:>8} {:>7}", first, "middle half", "passes", "M fetch", "MB");
    };
    std::string text = fmt::format(
        "{:<{}}{:<53}{}\n{:<{}}{}{}\n", "", kWidth, "   added to the rest of the scene",
        "   added to the bodies and what it needs", "", kWidth, columns(ms.c_str()), columns(ms.c_str()));
    for (const EffectStudy::Row* row : costliest_first(m))
        text += fmt::format("{:<{}}{}{}\n", row->effect, kWidth, added_text(m, row->to_whole),
                            added_text(m, row->to_bare));
    text += fmt::format("{:<{}}{}\n", "all but the bodies", kWidth, added_text(m, m.study.all_but_bodies));
    text +=
        "Middle half: of what was added, round by round. Where it holds 0, the effect is lost in this "
        "machine's noise.\n";
    for (const EffectStudy::Row& row : m.study.rows) {
        if (row.leaves_with_it.empty()) continue;
        std::string names;
        for (const std::string_view name : row.leaves_with_it)
            names += (names.empty() ? "" : ", ") + std::string(name);
        text += fmt::format("{} left out takes along: {}\n", row.effect, names);
    }
    return text;
}

std::string summary_of(const EffectCosts& m) {
    const EffectAdded& rest = m.study.all_but_bodies;
    const double whole = median(by(m.clock, m.with(rest).times)),
                 bare = median(by(m.clock, m.without(rest).times));
    const double whole_mb = mega(m.with(rest).cost.texture_bytes),
                 bare_mb = mega(m.without(rest).cost.texture_bytes);
    return fmt::format(
        "{}: {:.2f} of {:.2f} {} ms a step, {:.1f} times as fast as the whole scene; {:.1f} of {:.1f} MB of "
        "textures\n",
        m.study.variants[rest.without].name, bare, whole, to_string(m.clock), whole / bare, bare_mb,
        whole_mb);
}

std::string csv_of(const EffectCosts& m) {
    std::string text = "effect,added_to,with,without";
    for (const char* count : {"passes", "uniforms", "texels", "bytes_written", "fetches", "texture_bytes"})
        text += fmt::format(",{0}_with,{0}_without", count);
    for (const CostClock clock : clocks_of(m))
        text += fmt::format(
            ",{0}_ms_with_p50,{0}_ms_with_p95,{0}_ms_without_p50,{0}_ms_without_p95,{0}_ms_added_p25,"
            "{0}_ms_added_p50,{0}_ms_added_p75",
            to_string(clock));
    text += "\n";
    const auto line = [&](std::string_view effect, const char* added_to, const EffectAdded& added) {
        text += fmt::format("{},{},{},{}", effect, added_to, m.study.variants[added.with].name,
                            m.study.variants[added.without].name);
        const StepCost &a = m.with(added).cost, &b = m.without(added).cost;
        text += fmt::format(",{},{},{},{},{},{},{},{},{},{},{},{}", a.work.passes, b.work.passes,
                            a.work.uniforms, b.work.uniforms, a.work.texels, b.work.texels, a.work.bytes,
                            b.work.bytes, a.work.fetches, b.work.fetches, a.texture_bytes, b.texture_bytes);
        for (const CostClock clock : clocks_of(m)) {
            const std::vector<double>&with = by(clock, m.with(added).times),
                  &without = by(clock, m.without(added).times), ms = added_ms(m, added, clock);
            text += fmt::format(",{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}", median(with),
                                percentile_95(with), median(without), percentile_95(without),
                                percentile(ms, 25), median(ms), percentile(ms, 75));
        }
        text += "\n";
    };
    for (const EffectStudy::Row& row : m.study.rows) {
        line(row.effect, "whole", row.to_whole);
        line(row.effect, "bare", row.to_bare);
    }
    line("all but the bodies", "whole", m.study.all_but_bodies);
    return text;
}

}  // namespace eddy::effects
