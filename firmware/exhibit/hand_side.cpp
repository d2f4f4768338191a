#include "firmware/exhibit/hand_side.h"

#include <pthread.h>

#include <algorithm>

namespace eddy {
namespace {

constexpr std::size_t kTraced = 20000;  // ticks that wait for whoever follows, at most
constexpr std::size_t kAtOnce = 4096;

}  // namespace

HandSide::HandSide(std::unique_ptr<HapticDevice> device, std::string name, const HapticLoopSettings& settings,
                   const std::filesystem::path& flights, const StopInput* stop_input)
    : device_(std::move(device)), name_(std::move(name)), trace_(kTraced), ticks_(kAtOnce) {
    if (!device_) return;
    flights_ = std::make_unique<FlightRecorder>(settings);
    loop_.emplace(*device_, exchange_, trace_, settings, flights_.get(), stop_input);
    if (!flights.empty()) flight_keeper_.emplace(*flights_, flights);
}

void HandSide::start(Clock& clock) {
    if (!loop_) return;
    stop_ = false;
    thread_ = std::thread([this, &clock] {
        pthread_setname_np(pthread_self(), "eddy:hand");
        grant_ = grant_realtime(loop_->memory());
        granted_.store(true, std::memory_order_release);
        loop_->run(clock, stop_);
    });
}

void HandSide::tick(Instant now) {
    if (loop_) loop_->tick(now);
}

void HandSide::end() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    if (device_) name_ = device_->describe();
}

std::optional<std::string> HandSide::grant_news() {
    if (!granted_.exchange(false, std::memory_order_acquire)) return std::nullopt;
    return sentence_of(grant_);
}

void HandSide::follow(const std::function<void(std::span<const TickRecord>)>& each) {
    while (const std::size_t count = trace_.drain(ticks_)) {
        const std::span<const TickRecord> part(ticks_.data(), count);
        for (const TickRecord& tick : part)
            sent_most_n_ = std::max(sent_most_n_, glm::length(tick.sent_force_n));
        if (each) each(part);
    }
    report_ = exchange_.report.newest();
    was_ready_ = was_ready_ || report_.device == HapticState::Ready;
}

void HandSide::finish_flights() {
    if (flight_keeper_) flight_keeper_->finish();
}

std::optional<std::string> HandSide::flight_news() {
    return flight_keeper_ ? flight_keeper_->news() : std::nullopt;
}

}  // namespace eddy
