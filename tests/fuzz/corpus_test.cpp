#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <span>
#include <vector>

#include "tests/fuzz/config_targets.h"
#include "tests/fuzz/targets.h"

// What libFuzzer once took to be worth keeping, each input again (script/fuzz --keep; tests/fuzz/corpus).

namespace eddy {
namespace {

struct Target {
    const char* name;
    void (*takes)(std::span<const std::uint8_t>);
};

void PrintTo(const Target& target, std::ostream* out) {
    *out << target.name;
}

/// Targets end the program if something does not hold: then this is the input.
char current[256];
void name_it(int) {
    std::fprintf(stderr, "of the corpus: %s\n", current);
}

class FuzzCorpus : public testing::TestWithParam<Target> {};

TEST_P(FuzzCorpus, IsTakenOrRefused) {
    const std::filesystem::path folder = std::filesystem::path(EDDY_FUZZ_CORPUS) / GetParam().name;
    int inputs = 0;
    std::signal(SIGABRT, name_it);
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        std::snprintf(current, sizeof(current), "%s", entry.path().c_str());
        std::ifstream file(entry.path(), std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
        GetParam().takes({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
        ++inputs;
    }
    std::signal(SIGABRT, SIG_DFL);
    EXPECT_GT(inputs, 10);
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus,
                         testing::Values(Target{"frames", fuzz_frames}, Target{"firmware", fuzz_firmware},
                                         Target{"packets", fuzz_packets}, Target{"flight", fuzz_flight},
                                         Target{"exhibit", fuzz_exhibit}, Target{"scene", fuzz_scene}),
                         [](const auto& target) { return target.param.name; });

}  // namespace
}  // namespace eddy
