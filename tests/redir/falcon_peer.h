#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "tests/redir/redir_server.h"
#include "tests/redir/steered_motion.h"

namespace eddy::redir {

struct FalconPeerSettings {
    emulated::BoardState start = emulated::BoardState::RunHomed;
    emulated::Hand hand = emulated::Hand::Arm;
    bool homes = true;  ///< the hand homes the handle when the firmware is asked to look for its index marks
    std::string serial = "EMUL0001";
};

/// The emulated Falcon, with a hand on its handle that can be told what to do:
///
///     hold X Y Z     the hand goes there and stays [m, Device frame]
///     follow         it takes up its path again
///     let-go         nobody holds the handle (hold, follow and home take hold of it again)
///     home           out, in, and on
///     press N [MS]   a button of the grip: 0 right, 1 top, 2 centre, 3 left; for so long, or until release N
///     silent TIME    nothing from the board reaches its USB chip for so long: the chip sends its empty packets
///     hang TIME      the whole device says and takes nothing
///     power-loss     its 30 V supply fails for a moment: firmware gone
class FalconPeer final : public LivePeer {
  public:
    FalconPeer(std::unique_ptr<emulated::HandMotion> path, const FalconPeerSettings& settings);

    std::span<const std::uint8_t> descriptors() const override { return device_.descriptors(); }
    void poll(Instant now) override;
    void submit(const Urb& urb) override { device_.submit(urb); }
    bool cancel(const void* id) override { return device_.cancel(id); }
    std::optional<Urb> reap() override { return device_.reap(); }
    /// Its own supply keeps the firmware running.
    void unplug() override { device_.unplug(); }
    void plug_in() override { device_.plug_in(true); }
    void reset() override;
    std::string command(Instant now, std::string_view line) override;
    void report(Instant now, EventLog& log) override;
    /// A packet waits that long before it is carried on. The times in the device itself are exact.
    Instant tick() const override { return std::chrono::microseconds(200); }

    emulated::UsbDevice& device() { return device_; }
    emulated::EmulatedBoard& board() { return device_.falcon().board(); }
    /// On the hand, as the motors were last told [N, Device frame].
    glm::dvec3 force_n();

  private:
    /// What is told when it changes.
    struct Seen {
        emulated::BoardState state;
        bool red, green, blue;
        std::uint8_t buttons;
        bool operator==(const Seen&) const = default;
    };
    Seen look();
    void home_if_asked(Instant now);

    const FalconPeerSettings settings_;
    SteeredMotion* motion_;
    emulated::UsbDevice device_;
    bool held_ = true;
    Instant home_again_at_{0};
    std::array<std::optional<Instant>, 4> released_at_{};
    std::optional<Instant> speaks_at_, wakes_at_;

    std::optional<Seen> reported_;
    Instant second_began_{0};
    std::uint64_t frames_before_ = 0;
    double peak_n_ = 0.0;
};

}  // namespace eddy::redir
