#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "firmware/flight_keeper.h"
#include "firmware/hand_orders.h"
#include "firmware/haptic/loop.h"
#include "firmware/haptic/realtime.h"

namespace eddy {

/// The hand's side of the exhibit: the device, the 1 kHz loop on it, and what is kept of its last seconds. It goes on whatever
/// becomes of the picture and the fluid; its force fades when nobody answers. All calls from one thread, the fluid's.
class HandSide {
  public:
    /// `device` may be null: then nobody ever holds anything. `flights`: folder for the seconds before a fault; empty: they are
    /// not kept.
    /// `stop_input`, if any: looked at in every tick, see HapticLoop. It must outlive this.
    HandSide(std::unique_ptr<HapticDevice> device, std::string name, const HapticLoopSettings& settings,
             const std::filesystem::path& flights, const StopInput* stop_input = nullptr);
    /// The last thing that is sent is zero.
    ~HandSide() { end(); }
    HandSide(const HandSide&) = delete;
    HandSide& operator=(const HandSide&) = delete;

    bool has_device() const { return device_ != nullptr; }
    HapticExchange& exchange() { return exchange_; }
    HandOrders& orders() { return orders_; }

    /// Starts the loop on a thread of its own, at real-time priority if that is granted. `clock` must outlive it.
    void start(Clock& clock);
    /// In place of start(), for those who keep time themselves.
    void tick(Instant now);
    /// Ends the thread; waits for it.
    void end();
    /// Once, when the loop's thread has begun: what the system granted it, for the log.
    std::optional<std::string> grant_news();

    /// Takes in what the loop did since the last call; each part of its ticks, in order, goes to `each`.
    void follow(const std::function<void(std::span<const TickRecord>)>& each = {});
    const LoopReport& report() const { return report_; }
    double sent_most_n() const { return sent_most_n_; }
    /// The device was ready since the start.
    bool was_ready() const { return was_ready_; }

    /// What the loop keeps of its last seconds; null: there is no loop.
    const FlightRecorder* flights() const { return flights_.get(); }
    /// Completes what is kept of faults; the loop must have ended.
    void finish_flights();
    /// What was kept since the last call, for the log.
    std::optional<std::string> flight_news();
    std::uint64_t flights_kept() const { return flight_keeper_ ? flight_keeper_->kept() : 0; }

    /// What it is, for the log; with the device's state once the loop has ended, for only the loop may ask the device.
    const std::string& name() const { return name_; }

  private:
    std::unique_ptr<HapticDevice> device_;
    std::string name_;
    HapticExchange exchange_;
    HandOrders orders_{exchange_};
    TickTrace trace_;
    std::vector<TickRecord> ticks_;
    std::unique_ptr<FlightRecorder> flights_;
    std::optional<HapticLoop> loop_;
    std::optional<FlightKeeper> flight_keeper_;
    RealtimeGrant grant_;
    std::atomic<bool> granted_{false};  ///< the thread has written what is above
    std::atomic<bool> stop_{false};
    std::thread thread_;
    LoopReport report_;
    double sent_most_n_ = 0.0;
    bool was_ready_ = false;
};

}  // namespace eddy
