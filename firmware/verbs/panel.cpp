#include <fmt/format.h>

#include "firmware/exhibit/lamp_table.h"
#include "firmware/exhibit/panel_check.h"
#include "firmware/verbs/stop.h"
#include "firmware/verbs/verbs.h"
#include "hal/gpio/real_gpio.h"

namespace eddy {

int diagnose_panel(const PanelOptions& options) {
    if (options.codes) {
        fmt::print("{}", lamp_table());
        return 0;
    }
    const GpioConfig config = load_exhibit(options.config).exhibit.gpio;
    stop_on_signals();
    RealClock clock;
    // Each line as it happens, through a pipe too.
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const auto gpio = make_real_gpio();
    return check_panel(*gpio, config, {options.code, options.seconds}, clock, stdout, asked_to_stop) ? 0 : 1;
}

}  // namespace eddy
