#pragma once

namespace eddy {

/// From now on Ctrl-C, a closed terminal and the service manager's SIGTERM do not end the program: they ask it to end, and its
/// loops look. Nobody at the other end of its output is no reason to end.
void stop_on_signals();
/// From now on a console that is taken away does not ask the program to end: whoever takes it hangs it up, and a show on a screen has
/// no use for it. After stop_on_signals.
void outlive_console();
/// Whether they have asked.
bool asked_to_stop();

}  // namespace eddy
