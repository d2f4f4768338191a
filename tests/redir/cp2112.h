#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "tests/redir/redir_server.h"

namespace eddy::redir {

/// A Silicon Labs CP2112, HID USB-to-SMBus bridge, with its eight lines as the Linux driver hid-cp2112 uses them; numbers
/// of reports and their lengths from that driver and from application note AN495. Nothing is on its SMBus: every transfer
/// ends without an acknowledgement. Outside, each line is pulled up until somebody pulls it down:
///
///     low N | high N    from now on
///     press N MS        low for so long, then high
class Cp2112 final : public LivePeer {
  public:
    static constexpr unsigned kLines = 8;

    Cp2112();

    std::span<const std::uint8_t> descriptors() const override { return descriptors_; }
    void poll(Instant now) override;
    void submit(const Urb& urb) override;
    bool cancel(const void* id) override;
    std::optional<Urb> reap() override;
    void unplug() override;
    void plug_in() override { plugged_in_ = true; }
    void reset() override;
    std::string command(Instant now, std::string_view line) override;
    void report(Instant now, EventLog& log) override;
    /// It says nothing of its own accord; only buttons are let go.
    Instant tick() const override { return std::chrono::milliseconds(5); }

    /// What a voltmeter at the lines would show, one bit each.
    std::uint8_t levels() const;
    /// Lines that the guest drives.
    std::uint8_t outputs() const { return directions_; }

  private:
    using Bytes = std::vector<std::uint8_t>;
    /// What it answers; nothing: it stalls.
    std::optional<Bytes> answer(std::span<const std::uint8_t> setup, std::span<const std::uint8_t> data);
    std::optional<Bytes> standard_answer(std::uint8_t request, std::uint16_t value) const;
    std::optional<Bytes> get_report(std::uint8_t number) const;
    bool set_report(std::uint8_t number, std::span<const std::uint8_t> data);
    void output_report(std::span<const std::uint8_t> data);
    void end(const Urb& urb, Urb::Status status);
    void begin_anew();

    const Bytes descriptors_;
    bool plugged_in_ = false;
    std::deque<Urb> waiting_, reads_, ended_;
    std::deque<Bytes> to_say_;  // input reports

    std::uint8_t directions_ = 0;  // 1: output
    std::uint8_t push_pull_ = 0;   // 1: push-pull, else open drain
    std::uint8_t special_ = 0;     // lines 0, 1, 7 blink or tick by themselves: not emulated, only kept
    std::uint8_t divider_ = 0;
    std::uint8_t latch_ = 0xFF;
    Bytes smbus_config_;

    std::uint8_t outside_ = 0xFF;
    std::array<std::optional<Instant>, kLines> released_at_{};
    std::optional<std::array<std::uint8_t, 3>> reported_;
};

}  // namespace eddy::redir
