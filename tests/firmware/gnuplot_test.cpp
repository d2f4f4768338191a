#include "firmware/gnuplot.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using testing::HasSubstr;

/// The folder that the program is in, for as long as this lives.
class In {
  public:
    explicit In(const std::filesystem::path& folder) : before_(std::filesystem::current_path()) {
        std::filesystem::current_path(folder);
    }
    ~In() { std::filesystem::current_path(before_); }
    In(const In&) = delete;
    In& operator=(const In&) = delete;

  private:
    std::filesystem::path before_;
};

TEST(Gnuplot, ScriptDrawsThePictureAgainFromAnyFolder) {
    if (std::system("gnuplot --version > /dev/null") != 0)
        GTEST_SKIP() << "skipped: gnuplot is not installed";
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path() / "it's here");
    const std::string picture = folder / "it's here/line.png";
    {
        const In in(folder.path());
        const std::vector<std::filesystem::path> drawn =
            draw_with_gnuplot({{"it's here/line.png", 300, 200, "plot x\n"}});
        EXPECT_THAT(drawn, testing::ElementsAre("it's here/line.png"));
    }
    const std::string before = read_all(picture);
    EXPECT_EQ(before.substr(1, 3), "PNG");
    std::filesystem::remove(picture);
    const In in("/");
    EXPECT_EQ(std::system(("gnuplot \"" + (folder / "it's here/line.gnuplot") + "\"").c_str()), 0);
    EXPECT_EQ(read_all(picture), before);
}

TEST(Gnuplot, SaysWhichPicturesAreMissingAndWhereTheirScriptsAre) {
    const ScratchFolder folder;
    testing::internal::CaptureStderr();
    const std::vector<std::filesystem::path> drawn =
        draw_with_gnuplot({{folder / "a.png", 300, 200, "plot no_such_function(x)\n"},
                           {folder / "b.png", 300, 200, "plot x\n"},
                           {folder / "c.png", 300, 200, "plot no_such_function(x)\n"}});
    const std::string said = testing::internal::GetCapturedStderr();
    const std::string a = folder / "a.gnuplot", b = folder / "b.gnuplot", c = folder / "c.gnuplot";
    if (drawn.empty())  // where gnuplot is not installed
        EXPECT_THAT(said, HasSubstr("not drawn: a.png, b.png, c.png: gnuplot is not installed (package "
                                    "gnuplot-nox); to draw them later, run gnuplot on " +
                                    a + " " + b + " " + c));
    else
        EXPECT_THAT(said,
                    HasSubstr("not drawn: a.png, c.png: gnuplot failed; to draw them later, run gnuplot on " +
                              a + " " + c));
    for (const char* script : {"a.gnuplot", "b.gnuplot", "c.gnuplot"})
        EXPECT_THAT(read_all(folder / script), HasSubstr("plot ")) << script;
}

}  // namespace
}  // namespace eddy
