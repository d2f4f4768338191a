#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "hal/clock.h"
#include "hal/haptic/haptic_device.h"

namespace eddy {

/// How the exhibit is, for whoever looks at its lamps.
enum class LampCode : std::uint8_t {
    Starting,
    Show,
    Attract,
    HandOn,
    Closed,
    Degraded,
    Fault,
    Stopped,
    Guide,
    ShuttingDown,
    Accepted,
    Rejected,
    LetGo,
};

/// A pattern is a letter for each kLampStep, from the left, again and again. Lamps: . none, G green, A amber, R red,
/// * all. A single lamp: . or *. The ring of the Falcon: . dark, R, G, B, Y yellow, C cyan, W white. Nothing is on or off for
/// less than a step, so nothing flashes more than twice a second.
struct LampRow {
    LampCode code;
    std::string_view word;
    std::string_view meaning;
    std::string_view three;  ///< of the three lamps
    std::string_view one;    ///< where there is one only
    std::string_view ring;   ///< of the Falcon
};
inline constexpr Instant kLampStep = std::chrono::milliseconds(250);

// clang-format off
inline constexpr std::array<LampRow, 13> kLampRows{{
    {LampCode::Starting, "starting", "the exhibit is starting",
     "A", "**..", "Y"},
    {LampCode::Show, "show", "the show runs",
     "G", "*", "G"},
    {LampCode::Attract, "attract", "the show runs, nobody is there",
     "GGGGGGGG........", "********........", "GGGGGGGGCCCCCCCC"},
    {LampCode::HandOn, "hand_on", "somebody holds the handle",
     "GGGGGGG.", "*******.", "C"},
    {LampCode::Closed, "closed", "closed: outside its opening hours",
     "G...............", "*...............", "B..............."},
    {LampCode::Degraded, "degraded", "it runs, but not with all it should have: no Falcon, no screen, a line away, fallback settings",
     "AA..", "*.*.*.*.......", "YY.."},
    {LampCode::Fault, "fault", "a fault that needs somebody: call the technician",
     "R.", "*.", "R."},
    {LampCode::Stopped, "stopped", "stopped: no force until a click on the button",
     "R", "*.*.*.*.*.......", "RRRRRRR."},
    {LampCode::Guide, "guide", "the guide pages are shown",
     "GGGGAAAA", "****....", "BBBBWWWW"},
    {LampCode::ShuttingDown, "shutting_down", "it ends and powers down: wait until all is dark",
     "****....", "*...", "W..."},
    {LampCode::Accepted, "accepted", "a new configuration was accepted",
     "G.G.....", "*.*.....", "G.G....."},
    {LampCode::Rejected, "rejected", "a new configuration was refused: the old one runs on",
     "A.A.A.....", "*.*.*.....", "Y.Y.Y....."},
    {LampCode::LetGo, "let_go",
     "the button has been held long enough: let go, and it shuts down; if held since the start, begins as the factory made it",
     "*", ".", "W"},
}};
// clang-format on

constexpr const LampRow& row_of(LampCode code) {
    return kLampRows[static_cast<std::size_t>(code)];
}

struct LampStates {
    bool green = false, amber = false, red = false;
    bool operator==(const LampStates&) const = default;
};

/// Pure: what is lit so long after the code began to be shown.
LampStates lamps(LampCode code, Instant shown);
/// The same where there is one lamp, of whatever colour.
bool lamp(LampCode code, Instant shown);
/// The same for the ring around the Falcon's handle.
HandleLight ring(LampCode code, Instant shown);

/// Shows codes one after the other, each from the beginning of its pattern; however fast they change, nothing flashes faster.
class LampPlayer {
  public:
    /// From the end of a step on: what is lit stays so for a whole one, or more.
    void show(LampCode code) { wanted_ = code; }
    /// Time goes on to `now`, which never goes back.
    void advance(Instant now);

    LampCode code() const { return code_; }
    /// Of code(), since it began, in whole steps.
    Instant shown() const { return shown_; }

  private:
    LampCode wanted_ = LampCode::Starting, code_ = LampCode::Starting;
    bool began_ = false;
    Instant since_{0}, shown_{0};
};

}  // namespace eddy
