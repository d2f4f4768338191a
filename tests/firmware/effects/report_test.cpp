#include "firmware/effects/report.h"

#include <gmock/gmock.h>

#include <sstream>

namespace eddy::effects {
namespace {

using testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// Of a scene with smoke and viscosity: the whole, the empty tank, without each. Three rounds of 10, 11 and 12 ms of the whole;
/// viscosity always costs 6 ms and smoke 1, 1 and 4.
EffectCosts small_measurement() {
    EffectCosts m{study_effects(read_scene("[smoke]\n[fluid]\nviscosity_pa_s = 0.1\n", "t.toml").scene),
                  CostClock::Cpu,
                  {}};
    const std::vector<double> cpu[] = {{10, 11, 12}, {3, 3, 3}, {4, 5, 6}, {9, 10, 8}};
    const std::int64_t passes[] = {50, 17, 20, 47};
    for (int v = 0; v < 4; ++v)
        m.variants.push_back(
            {{{.passes = passes[v], .uniforms = 2 * passes[v]}, 5, 1'000'000}, {cpu[v], {20, 20, 20}}});
    return m;
}

TEST(EffectReport, AddsUpRoundByRound) {
    const EffectCosts m = small_measurement();
    EXPECT_EQ(added_ms(m, m.study.rows[0].to_whole, CostClock::Cpu), (std::vector<double>{6, 6, 6}));
    EXPECT_EQ(added_ms(m, m.study.rows[1].to_whole, CostClock::Cpu), (std::vector<double>{1, 1, 4}));
    EXPECT_TRUE(added_ms(m, m.study.rows[1].to_whole, CostClock::Gpu).empty());
}

TEST(EffectReport, HasALineForEachVariantAndEachEffectTheCostliestFirst) {
    const EffectCosts m = small_measurement();
    const std::vector<std::string> variants = lines_of(table_of_variants(m));
    ASSERT_EQ(variants.size(), 2u + 4u);
    EXPECT_THAT(variants[2], HasSubstr("whole scene"));
    EXPECT_THAT(variants[2], HasSubstr(" 11.00    12.00    20.00    20.00      50       100"));
    const std::vector<std::string> effects = lines_of(table_of_effects(m));
    ASSERT_EQ(effects.size(), 2u + 2u + 2u);
    EXPECT_THAT(effects[2], HasSubstr("viscosity"));
    EXPECT_THAT(effects[2], HasSubstr("6.00     6.00 .. 6.00      30"));
    EXPECT_THAT(effects[3], HasSubstr("smoke"));
    EXPECT_THAT(effects[3], HasSubstr("1.00     1.00 .. 4.00       3"));
    EXPECT_THAT(effects[4], HasSubstr("all but the bodies"));
    EXPECT_THAT(summary_of(m), HasSubstr("empty tank: 3.00 of 11.00 cpu ms a step, 3.7 times as fast"));
}

TEST(EffectReport, OfEffectsThatNeedOthersSaysWhatGoesWithThem) {
    EffectCosts m{
        study_effects(read_scene("[smoke]\ndissipation_1_s = 1\n", "t.toml").scene), CostClock::Cpu, {}};
    m.variants.resize(m.study.variants.size(), {{}, {{1.0}, {1.0}}});
    EXPECT_THAT(table_of_effects(m), HasSubstr("smoke left out takes along: smoke fading\n"));
}

TEST(EffectReport, AsCsvHasAsManyFieldsInEachLineAsInItsHeader) {
    EffectCosts m = small_measurement();
    for (const bool has_gpu : {false, true}) {
        if (has_gpu)
            for (EffectCosts::Variant& variant : m.variants) variant.times.gpu_ms = {1, 2, 3};
        const std::vector<std::string> lines = lines_of(csv_of(m));
        ASSERT_EQ(lines.size(), 1u + 2u * 2u + 1u);
        const auto fields = std::count(lines[0].begin(), lines[0].end(), ',');
        EXPECT_EQ(fields, 3 + 12 + (has_gpu ? 21 : 14));
        for (const std::string& line : lines)
            EXPECT_EQ(std::count(line.begin(), line.end(), ','), fields) << line;
        EXPECT_THAT(lines[3], testing::StartsWith("smoke,whole,whole scene,without smoke,50,47,100,94,"));
        EXPECT_THAT(lines[5], testing::StartsWith("all but the bodies,whole,whole scene,empty tank,50,17,"));
    }
}

}  // namespace
}  // namespace eddy::effects
