#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A row that takes a moment, with both efforts.
std::vector<std::string> small_matrix(const std::string& out, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"stability", "--case",  "millimetres", "--grid",
                                       "8,9",       "--quick", "--out",       out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(Stability, ListsEveryCaseWithWhatItProvokes) {
    const Ended ended = eddy({"stability", "--list"});
    EXPECT_EQ(ended.status, 0);
    EXPECT_THAT(ended.out, HasSubstr("\n 7  piston "));
    EXPECT_THAT(ended.out, HasSubstr("provokes: "));
    EXPECT_THAT(ended.out, HasSubstr("there is no free surface"));
}

TEST(Stability, PartsPutTogetherAreTheWhole) {
    const ScratchFolder folder;
    for (const std::string part : {"1", "2"}) eddy(small_matrix(folder / part, {"--shard", part + "/2"}));
    const Ended all = eddy(small_matrix(folder / "all", {"--merge", folder / "1", folder / "2"}));
    EXPECT_EQ(all.status, has_gnuplot() ? 0 : 1) << all.err;
    EXPECT_THAT(all.out, HasSubstr("4 of 4 cells of single cases"));
    EXPECT_EQ(lines_of(read_all(folder / "all/stability.csv")).size(), 5u);
    EXPECT_THAT(read_all(folder / "all/report.md"),
                HasSubstr("| 28 | millimetres | 9^3 | least | 60 | green |"));
    const Ended half = eddy(small_matrix(folder / "half", {"--merge", folder / "1"}));
    EXPECT_EQ(half.status, 1);
    EXPECT_THAT(half.out, HasSubstr("2 of 2 (2 more not run) cells of single cases"));
    EXPECT_THAT(read_all(folder / "half/report.md"), HasSubstr("| 28 | millimetres | green | not run |"));
}

TEST(Stability, ARunThatWasCutShortGoesOn) {
    const ScratchFolder folder;
    eddy(small_matrix(folder / "out"));
    const std::vector<std::string> lines = lines_of(read_all(folder / "out/stability.csv"));
    ASSERT_EQ(lines.size(), 5u);
    // What is known is not tried again: not even where it could not have come out so.
    std::string cut = lines[0] + "\n" + lines[1] + "\n" + lines[3] + "\n";
    const std::size_t yes = cut.find("yes");
    ASSERT_NE(yes, std::string::npos);
    cut.replace(yes, 3, "no");
    std::ofstream(folder / "out/stability.csv") << cut;
    const Ended ended = eddy(small_matrix(folder / "out", {"--resume"}));
    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.out, HasSubstr("3 of 4 cells of single cases"));
    EXPECT_EQ(lines_of(read_all(folder / "out/stability.csv")).size(), 5u);
}

TEST(Stability, DrawsItsHeatMap) {
    if (!has_gnuplot()) GTEST_SKIP() << "skipped: gnuplot is not installed";
    const ScratchFolder folder;
    EXPECT_EQ(eddy(small_matrix(folder / "out")).status, 0);
    EXPECT_GT(read_all(folder / "out/heat_map.png").size(), 3000u);
}

TEST(Stability, SaysWhatIsWrongWithAnOrder) {
    EXPECT_EQ(eddy({"stability", "--case", "pistn"}).status, 2);
    EXPECT_THAT(eddy({"stability", "--case", "pistn"}).err, HasSubstr("nearest first: \"piston\""));
    EXPECT_THAT(eddy({"stability", "--grid", "2"}).err, HasSubstr("write a grid as"));
    EXPECT_THAT(eddy({"stability", "--resume"}).err, HasSubstr("--out"));
}

TEST(Stability, SaysWhatGoesWithWhat) {
    const auto refused = [](const std::vector<std::string>& arguments) {
        const Ended ended = eddy(arguments);
        EXPECT_EQ(ended.status, 2);
        return ended.err;
    };
    EXPECT_THAT(refused({"stability", "--fuzz", "1", "--case", "stall"}),
                HasSubstr("--case does not go with --fuzz, which takes --seed, --out"));
    EXPECT_THAT(refused({"stability", "--endless", "9", "--grid", "8"}),
                HasSubstr("--grid does not go with --endless, which takes --scene, --set, --out"));
    EXPECT_THAT(refused({"stability", "--hands", "1", "--out", "x"}),
                HasSubstr("--out does not go with --hands"));
    EXPECT_THAT(refused({"stability", "--hands", "1", "--fuzz", "1"}), HasSubstr("one at a time"));
    EXPECT_THAT(refused({"stability", "--seed", "3"}), HasSubstr("--seed goes with --fuzz or --hands only"));
    EXPECT_THAT(refused({"stability", "--scene", "jet"}), HasSubstr("--hands or --endless only"));
}

TEST(Stability, ARandomHandIsTheSameHandAgain) {
    const Ended once = eddy({"stability", "--hands", "1", "--seed", "7"});
    EXPECT_EQ(once.status, 0) << once.out << once.err;
    EXPECT_THAT(once.out, HasSubstr("0 of 1 random hands, 4 s each, broke the rule"));
    EXPECT_EQ(eddy({"stability", "--hands", "1", "--seed", "7"}).out, once.out);
}

/// A cell of the quick matrix that is red.
struct Red {
    std::string name, grid, effort;
    std::string reason;  ///< how it begins, a # for each number
};

/// Those that docs/stability.md explains. Whoever mends one takes it off.
const std::vector<Red> kKnownRed{
    // what flows in has nowhere to go: no pressure solves that
    {"covers-all", "8^3", "least", "the fluid moves at # m/s"},
    {"covers-all+nan-in-pressure", "25^3", "default", "the fluid moves at # m/s"},
    // a start at once is more than the cycles solve
    {"inflow-20hz", "8^3", "least", "# of what flows in does not flow out"},
    // bodies that overlap
    {"cross-through", "8^3", "default", "the bodies feel # of the peak more or less than"},
    {"cross-through", "8^3", "least", "the bodies feel # of the peak more or less than"}};

/// The red cells of the table on the terminal: a line each, and below it the reason, after the step.
std::vector<Red> red_cells(const std::vector<std::string>& lines) {
    static const std::regex kStep("^ *step [0-9]+: "), kNumber("[0-9]+([.][0-9]+)?(e[-+]?[0-9]+)?");
    std::vector<Red> found;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
        std::istringstream words(lines[i]);
        Red red;
        std::string number, steps, verdict;
        words >> number >> red.name >> red.grid >> red.effort >> steps >> verdict;
        if (verdict != "RED") continue;
        red.reason = std::regex_replace(std::regex_replace(lines[i + 1], kStep, std::string()), kNumber,
                                        std::string("#"));
        found.push_back(red);
    }
    return found;
}

bool is_known(const Red& red, const Red& known) {
    return red.name == known.name && red.grid == known.grid && red.effort == known.effort &&
           red.reason.starts_with(known.reason);
}

TEST(Stability, TheQuickMatrixIsAsGreenAsIsKnown) {
    const Ended ended = Program(eddy_command({"stability", "--quick"})).wait(std::chrono::minutes(9));
    const std::vector<Red> red = red_cells(lines_of(ended.out));
    for (const Red& cell : red)
        EXPECT_TRUE(std::any_of(kKnownRed.begin(), kKnownRed.end(),
                                [&](const Red& known) { return is_known(cell, known); }))
            << cell.name << " on " << cell.grid << ", " << cell.effort << ": " << cell.reason;
    for (const Red& known : kKnownRed)
        if (std::none_of(red.begin(), red.end(), [&](const Red& cell) { return is_known(cell, known); }))
            fmt::print(
                "{} on {}, {}, is green now, or red for another reason: take it off the known red cells\n",
                known.name, known.grid, known.effort);
    EXPECT_EQ(ended.status, red.empty() ? 0 : 1) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("of pairs are green"));
}

}  // namespace
}  // namespace eddy
