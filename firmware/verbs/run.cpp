#include "firmware/verbs/exhibit_run.h"
#include "firmware/verbs/stepped_run.h"
#include "firmware/verbs/stop.h"
#include "firmware/verbs/verbs.h"

namespace eddy {

int run(const RunOptions& options) {
    stop_on_signals();
    if (options.clock == ClockChoice::Stepped) return run_stepped(options);
    ExhibitRun run(options);
    return run.play();
}

}  // namespace eddy
