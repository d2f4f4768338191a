#include "firmware/exhibit/service.h"

#include <utility>

namespace eddy {
namespace {

using namespace std::chrono_literals;

}  // namespace

void Service::preparing(Instant now, std::string_view what) {
    say(now, what);
    if (ready_ || (extended_ && now - *extended_ < 1s)) return;
    extended_ = now;
    notify_.extend_start(kPreparation);
}

void Service::first_frame(Instant now) {
    ready_ = true;
    notify_.ready();
    heartbeats_.excuse(now);
    go_on(now);
}

void Service::go_on(Instant now) {
    if (!ready_ || !period_ || heartbeats_.needs_restart(now)) return;
    if (fed_ && now - *fed_ < *period_ / 4) return;
    fed_ = now;
    notify_.watchdog();
}

void Service::say(Instant now, std::string_view line) {
    if (line == said_ || (said_at_ && now - *said_at_ < 1s)) return;
    said_ = line;
    said_at_ = now;
    notify_.status(line);
}

void Service::long_work_begins() {
    if (!ready_ || !period_ || std::exchange(long_work_, true)) return;
    notify_.set_watchdog(kPreparation);
}

void Service::long_work_ends(Instant now) {
    if (!std::exchange(long_work_, false)) return;
    heartbeats_.excuse(now);
    notify_.set_watchdog(*period_);
    fed_.reset();
    go_on(now);
}

void Service::stopping() {
    notify_.stopping();
}

}  // namespace eddy
