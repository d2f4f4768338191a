#pragma once
#include <atomic>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "firmware/haptic/flight_recorder.h"

namespace eddy {

/// Writes the flights of a recorder into a folder, on a thread of its own and without haste: a flight takes a second to write,
/// and neither the loop nor the fluid may wait for it. The oldest go first when there are too many.
class FlightKeeper {
  public:
    /// Some 60 MB.
    static constexpr std::size_t kMostFiles = 20;

    /// The recorder must outlive this.
    FlightKeeper(FlightRecorder& recorder, std::filesystem::path folder);
    ~FlightKeeper() { finish(); }
    FlightKeeper(const FlightKeeper&) = delete;
    FlightKeeper& operator=(const FlightKeeper&) = delete;

    /// Writes what is left, of a loop that has ended, and keeps nothing more.
    void finish();

    /// What was written since the last call, or why something could not be.
    std::optional<std::string> news();
    std::uint64_t kept() const { return kept_; }

  private:
    void work();
    void keep(Flight flight);

    FlightRecorder& recorder_;
    const std::filesystem::path folder_;
    std::atomic<bool> stop_{false};
    std::atomic<std::uint64_t> kept_{0};
    std::mutex news_lock_;
    std::optional<std::string> news_;
    std::thread thread_;
};

/// The flights in a folder, the newest first.
std::vector<std::filesystem::path> flights_in(const std::filesystem::path& folder);

}  // namespace eddy
