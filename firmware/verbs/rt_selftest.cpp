#include <fmt/format.h>

#include <cstring>
#include <thread>

#include "firmware/destination.h"
#include "firmware/gnuplot.h"
#include "firmware/haptic/loop.h"
#include "firmware/haptic/realtime.h"
#include "firmware/loop_timing.h"
#include "firmware/progress.h"
#include "firmware/verbs/run_device.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

/// A device that is not ready by then is measured as it is.
constexpr Instant kStartTime = 15s;

struct Measured {
    RealtimeGrant grant;
    std::vector<Instant> ticks;
    LoopReport report;
    std::uint64_t exchanges = 0;
    Seconds duration{0.0};
};

/// The loop as the exhibit runs it, on its own thread, with the fluid at rest and no force.
Measured measure(HapticDevice& device, Seconds duration) {
    Measured measured;
    HapticExchange exchange;
    TickTrace trace(20000);
    HapticLoop loop(device, exchange, trace);
    RealClock clock;
    std::atomic<bool> stop{false};
    std::thread thread([&] {
        measured.grant = grant_realtime(loop.memory());
        loop.run(clock, stop);
    });
    std::vector<TickRecord> records(4096);
    Progress progress("rt-selftest");
    std::optional<Instant> began;
    std::uint64_t before = 0;
    for (;;) {
        std::this_thread::sleep_for(50ms);
        measured.report = exchange.report.newest();
        const Instant now = clock.now();
        const bool ready = measured.report.device == HapticState::Ready;
        if (!began && (ready || now > kStartTime)) {
            // What came before was the device's start.
            while (trace.drain(records) > 0) {
            }
            began = now;
            before = measured.report.device_counters.exchanges;
        }
        if (!began) continue;
        while (const std::size_t count = trace.drain(records))
            for (std::size_t i = 0; i < count; ++i) measured.ticks.push_back(records[i].t);
        measured.duration = now - *began;
        measured.exchanges = measured.report.device_counters.exchanges - before;
        progress.show(measured.duration.count(), duration.count());
        if (measured.duration >= duration) break;
    }
    stop = true;
    thread.join();
    return measured;
}

void print_grant(const RealtimeGrant& grant) {
    fmt::print("kernel      {}\n",
               grant.realtime_kernel
                   ? "real time (PREEMPT_RT)"
                   : "not real time: a package such as linux-image-rt-amd64 makes late ticks rarer");
    fmt::print("priority    {}\n", grant.fifo ? fmt::format("SCHED_FIFO {}", kHapticPriority)
                                              : fmt::format("refused: {}", std::strerror(grant.fifo_error)));
    fmt::print("memory      {}\n",
               grant.memory_error == 0
                   ? fmt::format("{:.1f} MB locked", 1e-6 * static_cast<double>(grant.locked_bytes))
                   : fmt::format("not locked: {}", std::strerror(grant.memory_error)));
}

/// What to write where, so that the system grants what it refused.
void print_cure(const RealtimeGrant& grant) {
    const bool locked = grant.memory_error == 0;
    if (grant.fifo && locked) return;
    fmt::print("cure        for a service, in its [Service] section:\n");
    if (!grant.fifo) fmt::print("                LimitRTPRIO={}\n", kHapticPriority);
    if (!locked) fmt::print("                LimitMEMLOCK={}M\n", kLockedMb);
    fmt::print(
        "            for somebody who logs in, in /etc/security/limits.d/eddy.conf (then log in anew):\n");
    if (!grant.fifo) fmt::print("                @eddy - rtprio {}\n", kHapticPriority);
    if (!locked) fmt::print("                @eddy - memlock {}\n", 1024 * kLockedMb);
}

/// How often each period came, in steps of 20 us; the last column has all that are longer.
bool plot(const Measured& measured, const std::filesystem::path& png) {
    constexpr double kColumnMs = 0.02, kLastMs = 3.0;
    std::vector<long> columns(static_cast<std::size_t>(kLastMs / kColumnMs) + 1);
    for (std::size_t i = 1; i < measured.ticks.size(); ++i) {
        const double period_ms = Seconds(measured.ticks[i] - measured.ticks[i - 1]).count() * 1e3;
        ++columns[static_cast<std::size_t>(std::min(period_ms, kLastMs) / kColumnMs)];
    }
    std::string data;
    for (std::size_t i = 0; i < columns.size(); ++i)
        if (columns[i] > 0)
            data += fmt::format("{:.3f} {}\n", (static_cast<double>(i) + 0.5) * kColumnMs, columns[i]);
    const GnuplotPicture picture{
        png, 800, 480,
        fmt::format(
            "$periods << EOD\n{}EOD\nset title 'Time between two ticks of the haptic loop: {} ticks'\n"
            "set xlabel '[ms]; the column at 3 holds all that are longer'\nset ylabel 'ticks'\n"
            "set xrange [0:3.1]\nset logscale y\nset yrange [0.5:*]\nset key off\n"
            "set style fill solid 0.8 noborder\nset boxwidth {}\n"
            "set arrow from 1.5, graph 0 to 1.5, graph 1 nohead lc rgb '#d03020' dt 2 front\n"
            "plot $periods with boxes lc rgb '#2050c0'\n",
            data, measured.ticks.size(), kColumnMs)};
    return !draw_with_gnuplot({picture}).empty();
}

}  // namespace

int rt_selftest(const RtSelftestOptions& options) {
    if (!options.plot.empty()) {
        if (std::filesystem::path(options.plot).extension() != ".png")
            throw InputError(fmt::format("--plot: {} does not end in .png", options.plot));
        check_destination("--plot", options.plot);
    }
    RunOptions run;
    run.haptics = options.haptics;
    RunDevice device = make_device(run, load_exhibit(options.config).exhibit);
    if (!device.device)
        throw InputError("--haptics none: there is no exchange to measure; leave it out, or use emulated");
    const Measured measured = measure(*device.device, Seconds(options.seconds));
    const LoopTiming timing = loop_timing(measured.ticks);
    const double exchanges_per_s = measured.duration.count() > 0.0
                                       ? static_cast<double>(measured.exchanges) / measured.duration.count()
                                       : 0.0;
    fmt::print("device      {}: {}\n", device.name, to_string(measured.report.device));
    print_grant(measured.grant);
    fmt::print(
        "period      mean {:.4f} ms, deviation {:.4f} ms, one in a thousand above {:.3f} ms, longest {:.3f} "
        "ms\n",
        timing.mean.count() * 1e3, timing.deviation.count() * 1e3, timing.p999.count() * 1e3,
        timing.longest.count() * 1e3);
    fmt::print("ticks       {} in {:.1f} s; since the start {} late by more than half a tick, {} left out\n",
               timing.ticks, measured.duration.count(), measured.report.late, measured.report.missed);
    fmt::print("exchange    {:.0f} a second\n", exchanges_per_s);
    const std::vector<std::string> missed = missed_limits(timing, exchanges_per_s);
    if (missed.empty()) fmt::print("verdict     good: a hand feels nothing of it\n");
    for (const std::string& line : missed) fmt::print("verdict     bad: {}\n", line);
    print_cure(measured.grant);
    const bool drawn = options.plot.empty() || plot(measured, options.plot);
    if (!options.plot.empty() && drawn) fmt::print("picture     {}\n", options.plot);
    return missed.empty() && drawn ? 0 : 1;
}

}  // namespace eddy
