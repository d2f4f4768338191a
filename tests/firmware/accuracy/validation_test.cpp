#include <gtest/gtest.h>

#include "firmware/accuracy/report.h"
#include "tests/gles/gl_fixture.h"

namespace eddy::accuracy {
namespace {

/// A limit that the solver is known to miss, with what is asked of it meanwhile. `eddy accuracy --validate` shows
/// the miss.
struct KnownMiss {
    std::string one;
    std::string quantity;
    double error;  ///< asked meanwhile
};
const std::vector<KnownMiss> kKnownMisses{
    {"A16-precise", "M / M_0 - 1", 0.08},  // neither transport conserves smoke; measured: 5.7 % more
    {"A16-fast", "M / M_0 - 1", 0.15},     // 11 % less
    // Two cycles leave that much divergence; with eight it is 5e-8.
    {"B8.1", "their sum / the latter, fast", 3e-4},  // measured: 1.3e-4
    // The three faces of a cell are carried along one path (gles/fluid/setup.h); with MacCormack it is 5e-4, and 2e-6 with 14
    // cycles.
    {"B8.4", "turned, dF / F, fast", 0.08},    // 5.7 %
    {"B8.4", "mirrored, dF / F, fast", 0.05},  // 3.3 %
};

bool is_tolerated(const std::string& one, const Quantity& quantity, const Reading& reading) {
    for (const KnownMiss& miss : kKnownMisses)
        if (miss.one == one && miss.quantity == quantity.name) return reading.error <= miss.error;
    return false;
}

std::vector<std::string> quick_cases() {
    std::vector<std::string> quick;
    for (const Case& one : all_cases())
        if (!one.quick.empty()) quick.push_back(one.name);
    return quick;
}

class Validation : public gles::GlTest, public testing::WithParamInterface<std::string> {};

TEST_P(Validation, KeepsItsLimits) {
    const Case& one = *cases_named(GetParam()).front();
    const Study made = study(gpu, one, one.quick);
    for (const Row& row : made.rows)
        for (std::size_t q = 0; q < row.readings.size(); ++q) {
            const Reading& reading = row.readings[q];
            RecordProperty(fmt::format("{} with {} cells", one.quantities[q].name, row.cells.x),
                           fmt::format("{:.6g}", reading.measured));
            EXPECT_TRUE(reading.verdict != Verdict::Missed ||
                        is_tolerated(one.name, one.quantities[q], reading))
                << one.quantities[q].name << table_of(made);
        }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    for (char& c : name)
        if (c == '-' || c == '.') c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Quick, Validation, testing::ValuesIn(quick_cases()), test_name);

}  // namespace
}  // namespace eddy::accuracy
