#pragma once

namespace eddy {

/// From now on Ctrl-C and the service manager's SIGTERM do not end the program: they ask it to end, and its loops look.
void stop_on_signals();
/// Whether they have asked.
bool asked_to_stop();

}  // namespace eddy
