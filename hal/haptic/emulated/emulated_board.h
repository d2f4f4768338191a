#pragma once
#include <array>
#include <cstdint>
#include <memory>

#include "hal/haptic/emulated/plant.h"
#include "hal/haptic/falcon/firmware_image.h"
#include "hal/haptic/falcon/kinematics.h"
#include "hal/haptic/falcon/protocol.h"

namespace eddy::emulated {

/// What the Falcon is doing. RunHomed with no valid frame for the watchdog time drops its torque until the
/// next one.
enum class BoardState { Cold, Pic, FindingRate, Loading, RunUnhomed, RunHomed };

struct BoardSettings {
    BoardState start = BoardState::RunHomed;
    Instant turnaround =
        std::chrono::microseconds(300);  ///< from the last byte of a command to the first of its reply
    Instant watchdog = std::chrono::milliseconds(20);  ///< of the firmware; the real one's time is unmeasured
    double motor_units_per_nm =
        falcon::kMotorUnitsPerNm;  ///< of the motors themselves, whatever the driver believes
    /// Counts that the encoders are off before they find their index marks.
    falcon::Axes unhomed_offset{412, -873, 160};
    bool leading_zero = false;   ///< the PIC's answer comes after a 00, as some hosts see it
    bool two_byte_echo = false;  ///< the boot ROM answers 13 41 instead of 41, as some drivers saw it
};

/// Troubles to choose from; each may be changed while running.
struct BoardFaults {
    int deaf_calls = 0;        ///< this many of the PIC's next questions stay unanswered
    int wrong_echo_at = -1;    ///< this byte of the next upload is echoed wrongly, once
    int lost_replies = 0;      ///< this many of the next replies are not sent
    int short_replies = 0;     ///< this many of the next replies lose their last two bytes
    int double_replies = 0;    ///< this many of the next replies are sent twice
    int garbage = 0;           ///< this many of the next replies follow five bytes of nonsense
    bool homing_lost = false;  ///< the homed bits are cleared, once, with the next command
    bool no_index = false;     ///< the left axis never finds its index mark
    bool no_supply = false;    ///< the 30 V adapter is not plugged in: encoders live, no torque, no homing
    Instant slow_reply{0};     ///< replies come so much later than the turnaround time
    Instant slow_answer{0};    ///< the PIC answers so late that its host may have asked again
    falcon::Axes encoder_error{};  ///< added to what the encoders report
};

/// The Falcon behind its USB chip: the PIC, the DSP's boot ROM and the firmware, with motors and encoders on
/// the handle. States and answers as libnifalcon's drivers rely on them.
class EmulatedBoard {
  public:
    /// Bytes that the board puts on the serial line, beginning at a time.
    struct Answer {
        std::array<std::uint8_t, 40> bytes{};
        std::size_t size = 0;
        Instant at{0};

        void add(std::uint8_t byte) { bytes[size++] = byte; }
    };

    EmulatedBoard(std::unique_ptr<HandMotion> motion, const PlantSettings& plant,
                  const BoardSettings& settings);

    void start(Instant now) { plant_.start(now); }
    /// Moves the handle on.
    void advance(Instant now);
    /// A byte arrives at this rate [Bd]. At a rate the board does not listen to, nothing is understood.
    Answer receive(Instant now, std::uint8_t byte, double rate);
    /// The DTR line changes, while the chip is set to this rate [Bd].
    void set_dtr(bool high, double rate);
    /// The 30 V supply fails and comes back.
    void lose_power();

    BoardState state() const { return state_; }
    const Plant& plant() const { return plant_; }
    Plant& plant() { return plant_; }
    /// The last valid frame; what it asks of the motors holds only in RunHomed and until the watchdog bites.
    const falcon::Command& last_command() const { return command_; }
    /// Largest motor value of any frame, and of those received before homing.
    int largest_motor() const { return largest_motor_; }
    int largest_motor_unhomed() const { return largest_motor_unhomed_; }
    std::uint64_t frames() const { return frames_; }
    std::uint64_t dropped_bytes() const { return finder_.dropped(); }

    std::uint8_t buttons = 0;  ///< pressed now; bits as in falcon::Reply
    BoardFaults faults;

  private:
    void pic_byte(std::uint8_t byte, Answer& answer);
    void load_byte(std::uint8_t byte, Answer& answer);
    void run_byte(Instant now, std::uint8_t byte, Answer& answer);
    void obey(Instant now, const falcon::Command& command);
    void reply(Answer& answer);
    falcon::Axes encoders() const;
    glm::dvec3 motor_force() const;

    BoardSettings settings_;
    Plant plant_;
    BoardState state_;
    bool dtr_ = false;
    std::size_t matched_ = 0;  // bytes of the PIC's question
    falcon::BootStream stream_;
    int loaded_ = 0;  // bytes
    falcon::FrameFinder finder_;
    falcon::Command command_;
    Instant commanded_at_{0};
    bool watchdog_bit_ = true;
    std::array<bool, 3> homed_{};
    int largest_motor_ = 0;
    int largest_motor_unhomed_ = 0;
    std::uint64_t frames_ = 0;
};

}  // namespace eddy::emulated
