#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "firmware/haptic/flight_file.h"
#include "firmware/haptic/flight_recorder.h"
#include "firmware/haptic/flight_rerun.h"
#include "firmware/input_error.h"
#include "loop_rig.h"
#include "tests/allocations.h"
#include "tests/scratch_folder.h"

namespace eddy {
namespace {

using testing::HasSubstr;

/// Somebody who stirs.
void stir(LoopRig& rig) {
    rig.device.path = [](Seconds t) {
        return 0.03 * glm::dvec3(std::sin(7.0 * t.count()), std::cos(5.0 * t.count()), 0.0);
    };
}

/// What a hand that stirs for eight seconds leaves when it is unplugged.
Flight unplugged() {
    LoopRig rig;
    stir(rig);
    for (int i = 0; i < 8000; ++i) {
        rig.fluid.force_n = -10.0 * rig.exchange.pose.newest().velocity_m_s;
        rig.fluid.velocity_m_s = rig.exchange.pose.newest().velocity_m_s;
        rig.tick();
    }
    rig.device.answers = false;
    rig.device.is = HapticState::Absent;
    rig.run(600);
    std::optional<Flight> flight = rig.flights.take();
    if (!flight) throw std::runtime_error("no flight");
    flight->version = EDDY_VERSION;
    flight->written = "2026-11-22T20:00:00Z";
    return *flight;
}

TEST(Flight, OfAFaultHoldsFiveSecondsBeforeItAndHalfASecondAfter) {
    const Flight flight = unplugged();
    EXPECT_EQ(flight.cause, GateReason::DeviceNotReady);
    EXPECT_EQ(flight.at, Instant(std::chrono::milliseconds(8001)));
    ASSERT_GE(flight.ticks.size(), 5000U);
    EXPECT_LE(flight.ticks.size(), 6000U);
    EXPECT_EQ(flight.ticks.back().in.now, flight.at + std::chrono::milliseconds(500));
    for (std::size_t i = 1; i < flight.ticks.size(); ++i)
        ASSERT_EQ(flight.ticks[i].in.now - flight.ticks[i - 1].in.now, flight.ticks[i].step);
    EXPECT_GE(flight.at - flight.ticks.front().in.now, Instant(std::chrono::milliseconds(4500)));
}

TEST(Flight, RunsAgainBitForBit) {
    const Flight flight = unplugged();
    double most_n = 0.0;
    for (const FlightTick& tick : flight.ticks) most_n = std::max(most_n, glm::length(tick.out.force_n));
    EXPECT_GT(most_n, 1.0) << "or there were nothing to compare";
    const Rerun again = rerun(flight);
    EXPECT_FALSE(again.first) << "tick " << *again.first << " of " << again.differing;
    EXPECT_EQ(again.outputs.size(), flight.ticks.size());
}

TEST(Flight, ThatWasWrittenAndReadRunsAgainBitForBitToo) {
    const Flight flight = unplugged();
    const std::string text = flight_text(flight);
    const Flight read = read_flight(text, "a");
    EXPECT_EQ(read.version, EDDY_VERSION);
    EXPECT_EQ(read.written, "2026-11-22T20:00:00Z");
    EXPECT_EQ(read.cause, flight.cause);
    EXPECT_EQ(read.at, flight.at);
    ASSERT_EQ(read.ticks.size(), flight.ticks.size());
    EXPECT_EQ(rerun(read).differing, 0U);
    EXPECT_EQ(flight_text(read), text);
    EXPECT_LT(text.size(), 3'000'000U);
}

/// The child of the next test finds its flight in the file that this variable names.
constexpr const char* kFlightToRun = "EDDY_FLIGHT_TO_RUN";

TEST(Flight, InAFileRunsAgainBitForBit) {
    const ScratchFolder folder;
    const char* given = std::getenv(kFlightToRun);
    const std::string file = given ? given : folder.write("own.flight", flight_text(unplugged()));
    std::ifstream in(file, std::ios::binary);
    const Rerun again = rerun(read_flight(std::string{std::istreambuf_iterator<char>(in), {}}, "f"));
    EXPECT_EQ(again.differing, 0U) << "of " << again.outputs.size() << ", by " << again.most_n
                                   << " N at most";
}

// The C library takes other functions on other processors, and they round otherwise: here those of one without fused products.
TEST(Flight, RunsAgainBitForBitOnAnOlderProcessor) {
    const ScratchFolder folder;
    const std::string file = folder.write("older_processor.flight", flight_text(unplugged()));
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2,-FMA_Usable,-FMA4_Usable,-AVX2_Usable",
               1);
        setenv(kFlightToRun, file.c_str(), 1);
        execl("/proc/self/exe", "tests", "--gtest_filter=Flight.InAFileRunsAgainBitForBit", nullptr);
        _exit(127);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0) << "the child says what differs";
}

TEST(Flight, SaysTheFirstTickInWhichALawOfAnotherKindDiffers) {
    Flight flight = unplugged();
    flight.ticks[1234].out.force_n.y =
        std::nextafter(flight.ticks[1234].out.force_n.y, std::numeric_limits<double>::infinity());
    EXPECT_EQ(rerun(flight).first, 1234U);
    EXPECT_EQ(rerun(flight).differing, 1U);
    flight.ticks[1234].out = rerun(flight).outputs[1234];
    // A hand that is elsewhere in one tick is another from there on.
    flight.ticks[2000].in.reading->position_m.x += 1e-3;
    EXPECT_EQ(rerun(flight).first, 2000U);
    EXPECT_GT(rerun(flight).differing, 100U);
}

TEST(Flight, KeepsNumbersThatAreNone) {
    LoopRig rig;
    rig.run(2000);
    rig.fluid.force_n = {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity(),
                         -0.0};
    rig.run(600);
    std::optional<Flight> flight = rig.flights.take();
    ASSERT_TRUE(flight);
    EXPECT_EQ(flight->cause, GateReason::NotFinite);
    flight->version = EDDY_VERSION;
    flight->written = "x";
    const Flight read = read_flight(flight_text(*flight), "a");
    const glm::dvec3 force_n = read.ticks.back().in.fluid.force_n;
    EXPECT_TRUE(std::isnan(force_n.x));
    EXPECT_EQ(force_n.y, -std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::signbit(force_n.z));
    EXPECT_EQ(rerun(read).differing, 0U);
}

TEST(FlightRecorder, KeepsEachFaultButNotWhatVisitorsDo) {
    const auto cause = [](const std::function<void(LoopRig&)>& happen) {
        LoopRig rig;
        rig.run(2000);
        happen(rig);
        rig.run(5600);
        const std::optional<Flight> flight = rig.flights.take();
        return flight ? flight->cause : GateReason::Open;
    };
    EXPECT_EQ(cause([](LoopRig& r) { r.fluid_runs = false; }), GateReason::FluidStale);
    EXPECT_EQ(cause([](LoopRig& r) { r.orders.stop = true, r.order(); }), GateReason::Stopped);
    EXPECT_EQ(cause([](LoopRig& r) { r.device.is = HapticState::Fault; }), GateReason::DeviceNotReady);
    EXPECT_EQ(cause([](LoopRig& r) { r.device.answers = false; }), GateReason::DeviceSilent);
    EXPECT_EQ(cause([](LoopRig&) {}), GateReason::Open);
    EXPECT_EQ(cause([](LoopRig& r) { r.orders.enabled = false, r.order(); }), GateReason::Open);
    EXPECT_EQ(cause([](LoopRig& r) { r.device.path = [](Seconds) { return glm::dvec3(0.0); }; }),
              GateReason::Open);
}

TEST(FlightRecorder, KeepsNothingOfADeviceThatWasNeverThere) {
    LoopRig rig;
    rig.device.is = HapticState::Absent;
    rig.run(5000);
    EXPECT_FALSE(rig.flights.take());
}

TEST(FlightRecorder, NamesAFlightAfterTheGravestOfTheFaultsInIt) {
    for (const int between : {200, 1000}) {
        LoopRig rig;
        rig.run(2000);
        rig.fluid_runs = false;
        rig.run(100 + between);
        if (between > 500) {
            EXPECT_EQ(rig.flights.take().value().cause, GateReason::FluidStale);
        }
        rig.device.is = HapticState::Absent;
        rig.run(700);
        const std::optional<Flight> flight = rig.flights.take();
        ASSERT_TRUE(flight) << between;
        EXPECT_EQ(flight->cause, GateReason::DeviceNotReady);
        EXPECT_EQ(flight->at, Instant(std::chrono::milliseconds(2101 + between)));
        EXPECT_EQ(flight->ticks.back().in.now - flight->at, Instant(std::chrono::milliseconds(500)));
    }
}

TEST(FlightRecorder, GoesOnWhileAFlightIsReadAndCountsWhatItLoses) {
    LoopRig rig;
    rig.run(2000);
    rig.device.is = HapticState::Homing;  // the first: handed out after half a second
    rig.run(600);
    rig.device.is = HapticState::Ready;
    rig.run(1500);
    rig.fluid_runs = false;  // the second: nobody has taken the first yet
    rig.run(1000);
    EXPECT_EQ(rig.flights.lost(), 1U);
    const std::optional<Flight> first = rig.flights.take();
    ASSERT_TRUE(first);
    EXPECT_EQ(first->cause, GateReason::DeviceNotReady);
    EXPECT_FALSE(rig.flights.take());
    rig.fluid_runs = true;
    rig.run(1500);
    rig.orders.stop = true;
    rig.order();
    rig.run(600);
    const std::optional<Flight> third = rig.flights.take();
    ASSERT_TRUE(third);
    EXPECT_EQ(third->cause, GateReason::Stopped);
    EXPECT_EQ(rerun(*third).differing, 0U);
}

TEST(FlightRecorder, KeepsAFaultThatComesAgainOnceAMinute) {
    LoopRig rig;
    int kept = 0;
    for (int second = 0; second < 130; ++second) {
        rig.device.is = second % 2 == 0 ? HapticState::Ready : HapticState::Homing;
        rig.run(1000);
        if (rig.flights.take()) ++kept;
    }
    EXPECT_EQ(kept, 3);
}

TEST(FlightRecorder, HandsOutAFaultThatTheLoopDidNotOutlive) {
    LoopRig rig;
    rig.run(2000);
    rig.orders.stop = true;
    rig.order();
    rig.run(10);
    EXPECT_FALSE(rig.flights.take());
    const std::optional<Flight> flight = rig.flights.take_unfinished();
    ASSERT_TRUE(flight);
    EXPECT_EQ(flight->ticks.size(), 2010U);
    EXPECT_FALSE(rig.flights.take_unfinished());
}

TEST(FlightRecorder, AllocatesNothingInTheLoop) {
    LoopRig rig;
    stir(rig);
    rig.run(10);
    const std::uint64_t before = allocations();
    rig.run(7000);
    rig.device.is = HapticState::Absent;
    rig.run(1000);
    EXPECT_EQ(allocations(), before);
    EXPECT_TRUE(rig.flights.take());
}

std::string refusal(const std::string& text) {
    try {
        read_flight(text, "f.flight");
    } catch (const InputError& e) {
        return e.what();
    }
    return "taken";
}

TEST(FlightFile, SaysWhatIsWrongWithAFile) {
    LoopRig rig;
    rig.run(2000);
    rig.orders.stop = true;
    rig.order();
    rig.run(10);
    Flight flight = *rig.flights.take_unfinished();
    flight.version = EDDY_VERSION;
    flight.written = "today";
    const std::string good = flight_text(flight);
    EXPECT_EQ(refusal(good), "taken");
    EXPECT_THAT(refusal(""), HasSubstr("f.flight: is not a flight recording"));
    EXPECT_THAT(refusal("t_s,x_m\n0,1\n"), HasSubstr("is not a flight recording"));
    EXPECT_THAT(refusal(good.substr(0, good.size() / 2)), HasSubstr("is not complete"));
    EXPECT_THAT(refusal(good + "more\n"), HasSubstr("is not complete"));
    std::string changed = good;
    changed[changed.find("tick ") + 5] ^= 1;
    EXPECT_THAT(refusal(changed), HasSubstr("was changed since it was written, or damaged"));
    EXPECT_EQ(refusal(changed).find('\n'), std::string::npos) << "one line";
    flight.version = "0.0.9";
    EXPECT_THAT(refusal(flight_text(flight)),
                HasSubstr("was flown by eddy 0.0.9, and this is eddy " EDDY_VERSION));
}

/// A flight whose state has this byte in every place in turn; the last line is right.
TEST(FlightFile, RefusesAStateThatNoLawWasEverIn) {
    Flight flight;
    flight.version = EDDY_VERSION;
    flight.written = "today";
    flight.ticks.resize(20);
    for (std::size_t i = 0; i < flight.ticks.size(); ++i) {
        FlightTick& tick = flight.ticks[i];
        tick.step = kTick;
        tick.in = {.now = static_cast<int>(i + 1) * kTick,
                   .reading = HandleReading{.taken_at = static_cast<int>(i + 1) * kTick},
                   .device = HapticState::Ready};
    }
    const std::string good = flight_text(flight);
    const std::size_t line = good.find("\nstate ");
    const std::size_t hex = good.find(' ', line + 7) + 1, end = good.find('\n', hex);
    const std::size_t ticks = good.rfind("\nend ") + 1;
    ASSERT_EQ(end - hex, 2 * sizeof(HandState));
    int refused = 0;
    for (std::size_t at = hex; at < end; at += 2) {
        std::string text = good.substr(0, ticks);
        text[at] = text[at + 1] = '7';
        text += fmt::format("end {} {:016x}\n", flight.ticks.size(), flight_sum(text));
        if (refusal(text) != "taken") {
            EXPECT_THAT(refusal(text), HasSubstr("no law was ever in this state"));
            ++refused;
            continue;
        }
        // Taken: then it can be run again, and what comes of it has a name.
        for (const LawOutput& out : rerun(read_flight(text, "f")).outputs)
            ASSERT_LT(static_cast<std::size_t>(out.reason), kGateSentences.size()) << at;
    }
    EXPECT_GT(refused, 30);
}

}  // namespace
}  // namespace eddy
