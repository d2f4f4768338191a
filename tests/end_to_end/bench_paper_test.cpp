#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

using testing::HasSubstr;

TEST(BenchPaper, DrawsTheFiguresAndOurRowsBelowThePublishedOnes) {
    const ScratchFolder folder;
    const std::string out = (folder.path() / "paper").string();
    const Ended ended = eddy({"bench", "--paper", out, "--grid", "8,16", "--repeats", "1"});
    ASSERT_EQ(ended.status, 0) << ended.err;
    for (const char* name : {"figure_8.png", "figure_9.png", "figure_10.png"})
        EXPECT_GT(std::filesystem::file_size(std::filesystem::path(out) / name), 1000u) << name;
    const std::vector<std::string> rows = lines_of(read_all(std::filesystem::path(out) / "paper.csv"));
    ASSERT_EQ(rows.size(), 3u);
    // Where the sum is made, of what, and by which clock: the processor's where it draws, else the wall's.
    EXPECT_THAT(rows[0],
                testing::ContainsRegex("^cells,sum_on_gpu_step_wall_ms,sum_on_gpu_fluid_(cpu|wall)_ms,"));
    EXPECT_THAT(rows[0],
                testing::ContainsRegex(",sum_on_cpu_step_wall_ms,.*,sum_on_cpu_integral_(cpu|wall)_ms$"));
    EXPECT_THAT(rows[1], testing::StartsWith("8,"));
    EXPECT_EQ(split(rows[1], ',').size(), split(rows[0], ',').size());
    const std::string page = read_all(std::filesystem::path(out) / "paper.md");
    for (const char* row : {"| Yang et al. 2009 | 70 × 70 × 70 | 55 |", "| Eddy, `yang2009` | 16 × 16 × 16 |",
                            "| Eddy, `fast` | 16 × 16 × 16 |", "| Eddy, `precise` | 16 × 16 × 16 |"})
        EXPECT_THAT(page, HasSubstr(row));
}

TEST(BenchPaper, SaysWhichFolderItCannotWriteTo) {
    const Ended ended = eddy({"bench", "--paper", "/proc/nowhere", "--grid", "8"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.err, HasSubstr("--paper"));
    EXPECT_THAT(ended.err, HasSubstr("/proc/nowhere"));
}

}  // namespace
}  // namespace eddy
