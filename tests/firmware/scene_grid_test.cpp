#include "firmware/scene_grid.h"

#include <gmock/gmock.h>

#include "firmware/input_error.h"

namespace eddy {
namespace {

using testing::HasSubstr;
using testing::Not;

Scene flat() {
    return read_scene("[tank]\nsize_m = [0.32, 0.16, 0.08]\ncells = [32, 16, 8]\n", "test.toml").scene;
}

std::string complaint(int cells, std::string_view asked_by = kAnyGrid) {
    try {
        with_longest_side(flat(), cells, asked_by);
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

TEST(SceneGrid, KeepsTheProportionsOfTheTank) {
    EXPECT_EQ(with_longest_side(flat(), 64).tank.cells, glm::ivec3(64, 32, 16));
    EXPECT_EQ(longest_side(with_longest_side(flat(), 20)), 20);
}

TEST(SceneGrid, ThatDoesNotFitIsRefusedInTheWordsOfWhoAsked) {
    EXPECT_THAT(complaint(27, kGridOption), HasSubstr("--grid 27: "));
    EXPECT_THAT(complaint(27, kGridOption), HasSubstr("27 x 13.5 x 6.75"));
    EXPECT_THAT(complaint(27), HasSubstr("a grid of 27: "));
    EXPECT_THAT(complaint(27), Not(HasSubstr("--grid")));
    EXPECT_EQ(complaint(28), "");
}

}  // namespace
}  // namespace eddy
