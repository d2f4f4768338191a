#include "firmware/stopwatch.h"

#include <time.h>

#include <algorithm>
#include <stdexcept>

namespace eddy {
namespace {

double milliseconds(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

double at_place(std::vector<double> values, std::size_t place) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

const char* to_string(CostClock clock) {
    switch (clock) {
        case CostClock::Gpu:
            return "gpu";
        case CostClock::Cpu:
            return "cpu";
        case CostClock::Wall:
            return "wall";
    }
    throw std::logic_error("a clock without a name");
}

const std::vector<double>& by(CostClock clock, const Timings& times) {
    return clock == CostClock::Gpu ? times.gpu_ms : clock == CostClock::Cpu ? times.cpu_ms : times.wall_ms;
}

double median(std::vector<double> values) {
    const std::size_t middle = values.size() / 2;
    return values.empty() ? 0.0 : at_place(std::move(values), middle);
}

double percentile(std::vector<double> values, std::size_t percent) {
    const std::size_t rank = (percent * values.size() + 99) / 100;  // rounded up, counted from 1
    return values.empty() ? 0.0 : at_place(std::move(values), std::max<std::size_t>(rank, 1) - 1);
}

double percentile_95(std::vector<double> values) {
    return percentile(std::move(values), 95);
}

void Stopwatch::forget() {
    order_.clear();
    timings_.clear();
}

Stopwatch::Moment Stopwatch::now() {
    gles::finish();
    return {milliseconds(CLOCK_PROCESS_CPUTIME_ID), milliseconds(CLOCK_MONOTONIC)};
}

Stopwatch::Stopwatch(gles::Gpu& gpu) : gpu_(gpu) {}

void Stopwatch::hear(std::string_view stage, bool begins) {
    if (begins) {
        begun_.push_back(now());
        return;
    }
    const Moment end = now(), begin = begun_.back();
    begun_.pop_back();
    const std::string name(stage);
    if (!timings_.contains(name)) order_.push_back(name);
    Timings& t = timings_[name];
    if (sampled_.insert(name).second) {
        if (kept_ > 0 && t.wall_ms.size() == 2 * kept_) {
            const auto old = static_cast<std::ptrdiff_t>(kept_);
            t.cpu_ms.erase(t.cpu_ms.begin(), t.cpu_ms.begin() + old);
            t.wall_ms.erase(t.wall_ms.begin(), t.wall_ms.begin() + old);
        }
        t.cpu_ms.push_back(0.0);
        t.wall_ms.push_back(0.0);
    }
    t.cpu_ms.back() += end.cpu_ms - begin.cpu_ms;
    t.wall_ms.back() += end.wall_ms - begin.wall_ms;
}

void Stopwatch::set_on(bool on) {
    if (on) sampled_.clear();
    if (on == on_) return;
    on_ = on;
    if (on)
        gpu_.watch_stages([this](std::string_view stage, bool begins) { hear(stage, begins); });
    else
        gpu_.watch_stages({});
}

Stopwatch::~Stopwatch() {
    set_on(false);
}

}  // namespace eddy
