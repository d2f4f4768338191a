#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "config/value.h"
#include "hal/clock.h"

namespace eddy {

/// What of the program has to get on for the exhibit to be alive.
enum class Part : std::uint8_t { Render, Haptic, Gpio, Config };

inline constexpr Word<Part> kParts[] = {
    {Part::Render, "render", "fluid and picture"},
    {Part::Haptic, "haptic", "the 1 kHz loop"},
    {Part::Gpio, "gpio", "who looks after button and lamps"},
    {Part::Config, "config", "who reads and keeps the files of the settings"},
};
constexpr std::span<const Word<Part>> words_of(Part) {
    return kParts;
}

/// Whether all of them get on, judged by time, not by frames: each has a count that it moves at its own pace, and each must
/// have moved it lately. One thread; the counts may come from others.
class Heartbeats {
  public:
    /// A part that has not got on for so long hangs.
    static constexpr Instant kPatience = std::chrono::seconds(2);

    /// A part that has to get on; from now on it has this long to begin.
    void expect(Part part, Instant now);
    /// From now on it hangs only after so long: it has to wait for something, or no more.
    void give(Part part, Instant patience);
    /// Its count as it is now. That of a part that is not expected means nothing.
    void see(Part part, std::uint64_t count, Instant now);
    /// After work of this thread that had to take long (a scene that is made): nobody else had a chance to be seen. Button and lamps
    /// need no excuse, for they end nothing before they are seen again; one that hangs all along would be told of as if it answered.
    void excuse(Instant now);

    /// The first part that hangs, if any.
    std::optional<Part> hanging(Instant now) const;
    /// Whether one does that a new process can be the cure for. Button and lamps are none: their bridge would hang that, too, before
    /// its first frame, and meanwhile the force is off (StopInput) and the show goes on. Nor are files: a new process would wait for
    /// the same disk.
    bool needs_restart(Instant now) const;

  private:
    struct Beat {
        std::uint64_t count = 0;
        Instant at{0};  ///< when it was seen to move
        Instant patience = kPatience;
    };
    std::array<std::optional<Beat>, std::size(kParts)> beats_{};
};

}  // namespace eddy
