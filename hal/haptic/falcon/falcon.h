#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hal/haptic/falcon/boot.h"
#include "hal/haptic/falcon/debounce.h"
#include "hal/haptic/falcon/exchange.h"
#include "hal/haptic/falcon/tracker.h"
#include "hal/haptic/falcon/transport.h"
#include "hal/haptic/haptic_device.h"

namespace eddy {

struct FalconSettings {
    /// The firmware to upload into a cold device; empty: only a device whose firmware already runs can be
    /// used.
    std::vector<std::uint8_t> firmware_image{};
    double motor_units_per_nm = falcon::kMotorUnitsPerNm;
    /// Lets the USB chip send each reply at its last byte ('>') instead of at the next beat of its 1 ms
    /// latency timer. Without it the exchange may fall to 500 a second. Documented by FTDI, not yet seen on a
    /// Falcon.
    bool flush_on_frame_end = true;
    /// Keeps the homing bit set once homed, so that lost homing is noticed. libnifalcon sets it, HDAL clears
    /// it.
    bool keep_homing_bit = true;
};

/// The Novint Falcon.
///
///   Absent -> Attaching -> Probing -> Booting -> Attaching -> Probing -> Homing -> Ready
///                          `-- answers at once: firmware runs already --^
///
/// Booting that fails ten times ends in Fault, from where it starts over. A device that stops answering goes
/// back to Absent from every state; one that loses its homed bits goes from Ready to Homing.
class Falcon final : public HapticDevice {
  public:
    /// Throws std::invalid_argument if a firmware image is given and is none.
    Falcon(std::unique_ptr<falcon::Transport> transport, FalconSettings settings);
    /// The last frame it sends asks for no torque and no lamps.
    ~Falcon() override;
    Falcon(const Falcon&) = delete;
    Falcon& operator=(const Falcon&) = delete;

    void poll(Instant now) override;
    std::optional<HandleReading> read() override;
    void command(const glm::dvec3& force_n) override;
    /// Not while replies may be old ones, nor where no pose of the handle has its counts.
    bool obeys() const override;
    void show(const HandleLight& light) override { light_ = light; }

    HapticState state() const override;
    HapticCounters counters() const override;
    Seconds silence(Instant now) const override;
    std::string describe() const override;

  private:
    enum class Step { Absent, Attaching, Probing, Booting, Homing, Ready, Fault };

    // One function for each state; each is called once a poll and has its own deadline.
    void absent();
    void attaching();
    void probing(bool answered);
    void booting();
    void homing(const std::optional<falcon::Reply>& reply);
    void ready(const std::optional<falcon::Reply>& reply);
    void fault();

    void enter(Step step, Instant time_allowed);
    void attach();
    void probe();
    void boot();
    void boot_failed();
    void become_ready();
    void lose();

    void take(const falcon::Reply& reply);
    void send(const falcon::Axes& motors);
    void send_force(const glm::dvec3& force_n);

    std::unique_ptr<falcon::Transport> transport_;
    FalconSettings settings_;
    falcon::Exchange exchange_;
    falcon::Boot boot_;
    falcon::RequestList requests_;
    falcon::Tracker tracker_;
    falcon::Debounce buttons_;

    Step step_ = Step::Absent;
    Instant now_{0};                      // of the last poll
    Instant deadline_{0};                 // of the current step
    bool loaded_ = false;                 // by us, since the device was found
    int failed_boots_ = 0;                // in a row
    bool was_unhomed_ = false;            // in this Homing, so that the encoders have jumped
    std::optional<Instant> homed_since_;  // all three axes
    std::optional<Instant> replied_at_;   // last good reply
    int idle_polls_ = 0;                  // while Ready: since the last command()
    bool zero_next_ = false;            // a reply stayed out: the next command is zero whatever is asked for
    HandleLight light_{.green = true};  // while Ready
    std::optional<HandleReading> reading_;  // not yet handed out
    HapticCounters counters_;
};

}  // namespace eddy
