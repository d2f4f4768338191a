#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/end_to_end/program.h"

namespace eddy {
namespace {

using testing::HasSubstr;

/// Runs eddy where no other program is found.
Ended eddy_alone(const std::vector<std::string>& arguments) {
    std::vector<std::string> command = eddy_command(arguments);
    command.insert(command.begin(), {"env", "PATH=/nowhere"});
    return Program(command).wait();
}

TEST(WithoutGnuplot, WhatWasMeasuredIsWrittenAndTheMissingPicturesAreNamed) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path() / "effects");
    struct Case {
        std::vector<std::string> arguments;
        std::vector<std::string> written;
        std::vector<std::string> missing;  ///< without .png
    };
    const Case cases[] = {{{"bench", "--effects", "rest", "--set", kTiny, "--repeats", "1", "--json",
                            folder / "effects/e.json", "--plot", folder / "effects/e.png"},
                           {"effects/e.json"},
                           {"effects/e"}},
                          {{"bench", "--paper", folder / "paper", "--grid", "8", "--repeats", "1"},
                           {"paper/paper.csv", "paper/paper.md"},
                           {"paper/figure_8", "paper/figure_9", "paper/figure_10"}},
                          {{"accuracy", "--sweep", "--case", "A1", "--grid", "8", "--out", folder / "sweep"},
                           {"sweep/accuracy.csv", "sweep/accuracy.json", "sweep/report.md"},
                           {"sweep/viscosity"}}};
    for (const Case& one : cases) {
        const Ended ended = eddy_alone(one.arguments);
        EXPECT_EQ(ended.status, 1) << ended.err;
        for (const std::string& file : one.written) EXPECT_NE(read_all(folder / file), "") << file;
        EXPECT_THAT(ended.err, HasSubstr("gnuplot is not installed"));
        for (const std::string& name : one.missing) {
            EXPECT_THAT(ended.err, HasSubstr(name.substr(name.find('/') + 1) + ".png"));
            EXPECT_THAT(ended.err, HasSubstr(folder / (name + ".gnuplot")));
            EXPECT_NE(read_all(folder / (name + ".gnuplot")), "") << name;
        }
        // The last line says what was written.
        EXPECT_THAT(lines_of(ended.out).back(),
                    testing::Not(testing::AnyOf(HasSubstr(".png"), HasSubstr("figures"))))
            << ended.out;
    }
}

}  // namespace
}  // namespace eddy
