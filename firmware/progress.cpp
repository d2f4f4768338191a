#include "firmware/progress.h"

#include <fmt/format.h>
#include <unistd.h>

namespace eddy {

void Progress::show(double done, double total, const std::string& note) {
    static const bool terminal = isatty(STDERR_FILENO) == 1;
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> since = now - last_, elapsed = now - start_;
    if (elapsed.count() < 1.0 || since.count() < (terminal ? 0.2 : 10.0)) return;
    last_ = now;
    const double share = total > 0.0 ? done / total : 0.0;
    std::string text = fmt::format("{}: {:.0f} %", what_, 100.0 * share);
    if (share > 0.02) text += fmt::format(", {:.0f} s left", elapsed.count() * (1.0 - share) / share);
    if (!note.empty()) text += ", " + note;
    fmt::print(stderr, "{}{}{}", terminal ? "\r\x1b[K" : "", text, terminal ? "" : "\n");
    std::fflush(stderr);
    open_ = terminal;
}

void Progress::finish() {
    if (open_) fmt::print(stderr, "\r\x1b[K");
    open_ = false;
}

}  // namespace eddy
