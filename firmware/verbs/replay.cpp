#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "firmware/destination.h"
#include "firmware/flight_plot.h"
#include "firmware/haptic/flight_file.h"
#include "firmware/haptic/flight_rerun.h"
#include "firmware/haptic/loop.h"
#include "firmware/text_file.h"
#include "firmware/verbs/verbs.h"

namespace eddy {
namespace {

/// A tick that took so long is worth a line.
constexpr Instant kLongTick = 2 * kTick;
constexpr std::size_t kMostLines = 40;

Flight flight_of(const std::string& file) {
    try {
        return read_flight(read_text_file(file), file);
    } catch (const InputError&) {
        throw;
    } catch (const std::runtime_error& e) {
        throw InputError(e.what());
    }
}

/// What a tick is told and answers; a new line begins where it changes.
std::string situation(const FlightTick& tick) {
    return fmt::format("{:8}  {:16}  {}{}{}", to_string(tick.in.device), to_word(tick.out.reason),
                       tick.in.orders.enabled ? "force on" : "force off", tick.in.orders.stop ? ", stop" : "",
                       tick.out.pose.buttons ? fmt::format(", buttons {:04b}", tick.out.pose.buttons) : "");
}

std::vector<std::string> timeline(const Flight& flight) {
    std::vector<std::string> lines;
    std::string before;
    for (const FlightTick& tick : flight.ticks) {
        std::string now = situation(tick);
        const double sent_n = glm::length(tick.out.force_n);
        const bool late = tick.step >= kLongTick;
        if (now == before && !late) continue;
        lines.push_back(fmt::format(
            "{:+9.3f}  {}, {:.2f} N{}", Seconds(tick.in.now - flight.at).count(), now, sent_n,
            late ? fmt::format("; {:.1f} ms after the tick before", Seconds(tick.step).count() * 1e3) : ""));
        before = std::move(now);
    }
    return lines;
}

void print_summary(const Flight& flight) {
    double most_n = 0.0;
    Instant longest{0};
    Seconds silence{0.0};
    for (const FlightTick& tick : flight.ticks) {
        most_n = std::max(most_n, glm::length(tick.out.force_n));
        longest = std::max(longest, tick.step);
        // Before its first reply a device is silent for ever.
        if (tick.in.now <= flight.at && std::isfinite(tick.in.silence.count()))
            silence = std::max(silence, tick.in.silence);
    }
    const Seconds before = flight.at - flight.ticks.front().in.now;
    const Seconds after = flight.ticks.back().in.now - flight.at;
    fmt::print("flight      written {} by eddy {}\n", flight.written, flight.version);
    fmt::print("cause       {}: {}\n", to_word(flight.cause), to_string(flight.cause));
    fmt::print("when        {:.3f} s after the start\n", Seconds(flight.at).count());
    fmt::print("kept        {} ticks: {:.3f} s before it and {:.3f} s after\n", flight.ticks.size(),
               before.count(), after.count());
    fmt::print("law         {}, at most {:g} N and {:g} N/s\n",
               flight.settings.law == ForceLaw::Model ? "model" : "filter", flight.settings.gate.max_force_n,
               flight.settings.gate.slew_n_per_s);
    fmt::print("extremes    {:.2f} N sent, {:.1f} ms between ticks, {:.1f} ms without a reply before it\n",
               most_n, Seconds(longest).count() * 1e3, silence.count() * 1e3);
}

void print_timeline(const Flight& flight) {
    const std::vector<std::string> lines = timeline(flight);
    fmt::print("  seconds  device    gate              orders\n");
    // What led to the end is worth more than how it began.
    const std::size_t left_out = lines.size() > kMostLines ? lines.size() - kMostLines : 0;
    if (left_out > 0) fmt::print("      ...  {} lines\n", left_out);
    for (std::size_t i = left_out; i < lines.size(); ++i) fmt::print("{}\n", lines[i]);
}

}  // namespace

int replay(const ReplayOptions& options) {
    if (!options.plot.empty()) {
        if (std::filesystem::path(options.plot).extension() != ".png")
            throw InputError(fmt::format("--plot: {} does not end in .png", options.plot));
        check_destination("--plot", options.plot);
    }
    const Flight flight = flight_of(options.flight);
    print_summary(flight);
    print_timeline(flight);
    const Rerun again = rerun(flight);
    if (again.first) {
        const FlightTick& tick = flight.ticks[*again.first];
        const glm::dvec3 then_n = tick.out.force_n, now_n = again.outputs[*again.first].force_n;
        fmt::print(
            "rerun       differs from tick {} on ({:+.3f} s), in {} of {}; a force by {:.3g} N at most\n",
            *again.first, Seconds(tick.in.now - flight.at).count(), again.differing, flight.ticks.size(),
            again.most_n);
        fmt::print("            {} then: {} {} {} N; {} now: {} {} {} N\n", to_word(tick.out.reason),
                   then_n.x, then_n.y, then_n.z, to_word(again.outputs[*again.first].reason), now_n.x,
                   now_n.y, now_n.z);
    } else {
        fmt::print("rerun       the same, bit for bit\n");
    }
    const bool drawn = options.plot.empty() || plot_flight(flight, options.plot);
    if (!options.plot.empty() && drawn) fmt::print("picture     {}\n", options.plot);
    return again.first || !drawn ? 1 : 0;
}

}  // namespace eddy
