#pragma once
#include <cstdint>
#include <filesystem>

namespace eddy {

/// What the kernel says of the machine's clock.
enum class KernelClock : std::uint8_t { Unsynchronised, Synchronised, NotTold };
/// Asks it (adjtimex). A sandbox may forbid the question (ProtectClock= in eddy.service does).
KernelClock ask_kernel();

/// Whether the machine's clock has been set since it was switched on by one that is right. The kernel knows, whoever set it
/// (systemd-timesyncd, chrony, ntpsec), but takes the word back after hours without a network; a clock that was right this
/// morning is right enough for opening hours. systemd-timesyncd leaves a file besides, as long as the machine runs, which a program that
/// may not ask the kernel can see. What was said once counts for the rest of the run.
class ClockSync {
  public:
    static constexpr const char* kTimesyncFile = "/run/systemd/timesync/synchronized";
    explicit ClockSync(std::filesystem::path file = kTimesyncFile) : file_(std::move(file)) {}

    bool look(KernelClock kernel);
    bool synchronised() const { return synchronised_; }

  private:
    std::filesystem::path file_;
    bool synchronised_ = false;
};

}  // namespace eddy
