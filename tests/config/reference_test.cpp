#include <gmock/gmock.h>

#include <gtest/gtest.h>
#include <algorithm>

#include "config/scene.h"

namespace eddy {
namespace {

using testing::HasSubstr;

TEST(Reference, TellsTypeRangeDefaultAndMeaning) {
    const std::string text = schema_reference();
    EXPECT_THAT(text, HasSubstr("\n## `[solver]`\n"));
    EXPECT_THAT(text, HasSubstr("| `dt_s` | a number | above 0 and at most 1 | `0.02` | time step |\n"));
    EXPECT_THAT(text, HasSubstr("\n## `[[body]]`\n"));
    EXPECT_THAT(text, HasSubstr("\n## `[body.oscillation]`\n"));
    EXPECT_THAT(text, HasSubstr("| `radius_m` | a number | above 0 and at most 1000 | must be given for "
                                "`sphere`, `capsule`, `cylinder`, `torus`, "
                                "`disk` |"));
    EXPECT_THAT(text, HasSubstr("| `x_low` | a word or a table |  | `\"slip\"` | left |\n"));
    EXPECT_THAT(text, HasSubstr("\n## `[tank.walls.x_low]`\n"));
    EXPECT_EQ(text.find("[tank.walls.x_high]"), std::string::npos);
    EXPECT_THAT(text, HasSubstr("| `initial_k` | a number or a formula |  | `0` | "));
    EXPECT_THAT(text, HasSubstr("\n## Formulas\n"));
    EXPECT_THAT(
        text, HasSubstr("`fast` cut cells, multigrid with 2 cycles, semi-Lagrangian transport; `precise` "));
}

TEST(Reference, BeginsWithASceneThatCanBeRead) {
    const std::string page = schema_reference(), begin = "```toml\n";
    const std::size_t from = page.find(begin) + begin.size();
    const Scene scene = read_scene(page.substr(from, page.find("```", from) - from), "example.toml").scene;
    EXPECT_EQ(scene.bodies.size(), 1u);
    EXPECT_EQ(scene.sources.size(), 1u);
}

TEST(Reference, RowsHaveFiveColumns) {
    std::istringstream lines(schema_reference());
    for (std::string line; std::getline(lines, line);) {
        if (line.substr(0, 1) == "|") {
            EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 6) << line;
        }
    }
}

}  // namespace
}  // namespace eddy
