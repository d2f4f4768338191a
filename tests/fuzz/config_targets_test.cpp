#include "tests/fuzz/config_targets.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "config/exhibit.h"

// The targets of script/fuzz for what people write, with inputs that a seed decides.

namespace eddy {
namespace {

TEST(ConfigFuzz, SettingsInLayersAreTakenOrRefused) {
    const std::string factory = print_exhibit({});
    const std::string layers =
        factory + "\n%%\nmax_force_n = 2\n[falcon]\nserial = \"F\"\n\n%%\nscene = \"stir\"\n";
    const std::string scraps[] = {"\n%%\n",
                                  "=",
                                  "[",
                                  "]",
                                  "\"",
                                  "nan",
                                  "-1",
                                  "9",
                                  "max_force_n = 1\n",
                                  "[[falcon]]\n",
                                  "\\u0000",
                                  "'''",
                                  "\xff",
                                  "presets = [\"fast\", \"precise\"]\n",
                                  "{}",
                                  "#",
                                  "\n"};
    std::mt19937_64 random(20261122);
    for (int i = 0; i < 5000; ++i) {
        SCOPED_TRACE(testing::Message() << "input " << i);
        std::string text = layers;
        for (auto times = random() % 4; times > 0; --times) {
            const std::size_t at = random() % text.size();
            if (random() % 2 == 0)
                text.erase(at, 1 + random() % 8);
            else
                text.insert(at, scraps[random() % std::size(scraps)]);
        }
        fuzz_exhibit(std::vector<std::uint8_t>(text.begin(), text.end()));
    }
}

}  // namespace
}  // namespace eddy
