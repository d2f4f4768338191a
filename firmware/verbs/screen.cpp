#include <fmt/format.h>

#include "firmware/graphics.h"
#include "firmware/screen_report.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

int diagnose_screen(const ScreenOptions& options) {
    const Exhibit exhibit = load_exhibit(options.config).exhibit;
    const auto machine = kms::make_machine();
    const ScreenReport report = report_screens(
        *machine, {options.connector.value_or(exhibit.screen.connector),
                   options.mode.value_or(exhibit.screen.mode), last_screen(exhibit.state_dir)});
    fmt::print("{}", report.text);
    return report.usable ? 0 : 1;
}

}  // namespace eddy
