#include "firmware/gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>

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

}  // namespace

std::string in_gnuplot_quotes(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
    return result + "'";
}

bool run_gnuplot(const std::filesystem::path& script, const std::string& plot_of) {
    const int status = run(script);
    if (status == 0) return true;
    fmt::print(
        stderr, "no plot of {}: {}; the script is {}\n", plot_of,
        status < 0 || status == 127 ? "gnuplot is not installed (package gnuplot-nox)" : "gnuplot failed",
        script.string());
    return false;
}

}  // namespace eddy
