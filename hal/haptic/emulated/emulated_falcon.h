#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "hal/haptic/emulated/emulated_board.h"
#include "hal/haptic/emulated/ring.h"
#include "hal/haptic/falcon/transport.h"

namespace eddy::emulated {

/// A Falcon at the level of USB, on virtual time that poll() moves: the FTDI chip (control requests, serial
/// line with its delays, FIFO, latency timer, status bytes) in front of the board. Deterministic; it knows no
/// other clock.
class EmulatedFalcon final : public falcon::Transport {
  public:
    EmulatedFalcon(std::unique_ptr<HandMotion> motion, const PlantSettings& plant,
                   const BoardSettings& board);

    void poll(Instant now) override;
    bool present() const override { return plugged_in_; }
    std::string_view serial() const override { return plugged_in_ ? "EMULATED" : ""; }
    falcon::Obstacle obstacle() const override { return falcon::Obstacle::NotFound; }
    std::uint64_t failures() const override { return failures_; }
    void submit_control(const falcon::ControlRequest& request) override;
    falcon::Transfer control() const override;
    void submit_out(std::span<const std::uint8_t> bytes) override;
    falcon::Transfer out() const override;
    bool take_in(falcon::Packet& packet) override;
    void close(std::span<const std::uint8_t> last_words) override;

    /// The host takes so many packets and no more until it says so again: the chip makes none that nobody asked for.
    void set_room(std::size_t packets);
    std::uint8_t latency_ms() const;

    /// Pulls the USB plug. Put back, the device comes up cold unless its own supply kept it running.
    void unplug();
    void plug_in(bool kept_power);

    EmulatedBoard& board() { return board_; }

    struct Record {
        Instant at;
        falcon::ControlRequest request;
        bool operator==(const Record&) const = default;
    };
    /// The control requests, oldest first; the first 512.
    std::span<const Record> requests() const { return std::span(requests_).first(request_count_); }

    bool stalled = false;     ///< both pipes refuse transfers
    bool line_noisy = false;  ///< the chip sees framing errors
    bool line_dead = false;   ///< nothing from the board reaches the chip
    bool splits = false;      ///< each byte from the board travels in a packet of its own
    double rate_error =
        0.0;  ///< the board hears the host's bytes this much faster than they were meant, relatively

  private:
    struct LineByte {
        Instant at;  // when its stop bit has passed
        std::uint8_t byte;
        double rate;
    };

    bool obey(const falcon::ControlRequest& request);
    void line_to_board();
    void line_to_chip();
    void send_packet(Instant at);
    bool packet_due(Instant at) const;
    bool has_room() const { return packets_.size() < room_; }
    void reset_chip();

    EmulatedBoard board_;
    Instant now_{0};
    bool started_ = false;
    bool plugged_in_ = true;

    // Chip
    double rate_ = 9600.0;                             // [Bd]
    Instant latency_ = std::chrono::milliseconds(16);  // FT232R data sheet: default of the latency timer
    std::optional<std::uint8_t> event_character_;
    bool event_seen_ = false;
    bool overrun_ = false;
    Instant last_in_{0};
    Ring<std::uint8_t, 256> fifo_;     // from the line, size as in the FT232R data sheet
    Ring<falcon::Packet, 8> packets_;  // transfers that the host keeps queued
    std::size_t room_ = 8;             // packets that may wait in there
    Ring<LineByte, 512> to_board_;
    Ring<LineByte, 512> to_chip_;
    Instant line_out_free_{0};
    Instant line_in_free_{0};

    // USB
    Instant control_done_{0};
    Instant out_done_{0};
    bool control_failed_ = false;
    bool out_failed_ = false;
    std::uint64_t failures_ = 0;

    std::array<Record, 512> requests_{};
    std::size_t request_count_ = 0;
};

}  // namespace eddy::emulated
