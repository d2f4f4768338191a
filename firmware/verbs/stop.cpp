#include "firmware/verbs/stop.h"

#include <atomic>
#include <csignal>

namespace eddy {
namespace {

std::atomic<bool> g_stop{false};

}  // namespace

void stop_on_signals() {
    struct sigaction action {};
    action.sa_handler = [](int) { g_stop = true; };
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGHUP, &action, nullptr);
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, nullptr);
}

void outlive_console() {
    struct sigaction action {};
    action.sa_handler = SIG_IGN;
    sigaction(SIGHUP, &action, nullptr);
}

bool asked_to_stop() {
    return g_stop;
}

}  // namespace eddy
