#include "firmware/gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>

#include "firmware/text_file.h"

extern char** environ;

namespace eddy {
namespace {

/// Exit status; -1 or 127 if there is no such program.
int run(const std::filesystem::path& script) {
    std::string program = "gnuplot", argument = script.string();
    char* arguments[] = {program.data(), argument.data(), nullptr};
    pid_t child = 0;
    if (posix_spawnp(&child, "gnuplot", nullptr, nullptr, arguments, environ) != 0) return -1;
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The style is that of a diagram in the plane; what has other axes sets its own.
std::string head_of(const GnuplotPicture& picture) {
    return fmt::format(
        "set terminal pngcairo size {},{} font 'sans,11' noenhanced\nset output {}\n"
        "set border 3 lc rgb '#404040'\nset tics nomirror\nset grid lt 1 lc rgb '#e0e0e0'\n",
        picture.width_px, picture.height_px,
        in_gnuplot_quotes(std::filesystem::absolute(picture.file).string()));
}

}  // namespace

std::string in_gnuplot_quotes(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
    return result + "'";
}

std::filesystem::path script_of(const GnuplotPicture& picture) {
    std::filesystem::path script = picture.file;
    return script.replace_extension(".gnuplot");
}

std::vector<std::filesystem::path> draw_with_gnuplot(const std::vector<GnuplotPicture>& pictures) {
    std::vector<std::filesystem::path> drawn;
    std::vector<std::string> missing, scripts;
    bool installed = true;
    for (const GnuplotPicture& picture : pictures) {
        const std::filesystem::path script = script_of(picture);
        replace_text_file(script, head_of(picture) + picture.commands);
        const int status = run(script);
        if (status == 0) {
            drawn.push_back(picture.file);
            continue;
        }
        installed &= status > 0 && status != 127;
        missing.push_back(picture.file.filename().string());
        scripts.push_back(script.string());
    }
    if (!missing.empty())
        fmt::print(stderr, "not drawn: {}: {}; to draw them later, run gnuplot on {}\n",
                   fmt::join(missing, ", "),
                   installed ? "gnuplot failed" : "gnuplot is not installed (package gnuplot-nox)",
                   fmt::join(scripts, " "));
    return drawn;
}

}  // namespace eddy
