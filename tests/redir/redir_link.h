#pragma once
#include <array>
#include <optional>
#include <string>

#include "hal/haptic/falcon/transport.h"
#include "tests/redir/wire.h"

namespace eddy::redir {

/// The Falcon's driver on a guest's end of the wire: what libusb and a guest's kernel are in QEMU. Time on the wire goes on
/// with poll().
class RedirLink final : public falcon::Transport {
  public:
    explicit RedirLink(Wire& wire) : wire_(wire) {}

    void poll(Instant now) override;
    bool present() const override { return named_; }
    std::string_view serial() const override { return serial_; }
    falcon::Obstacle obstacle() const override { return falcon::Obstacle::NotFound; }
    std::uint64_t failures() const override { return failures_; }
    void submit_control(const falcon::ControlRequest& request) override;
    falcon::Transfer control() const override { return control_.state; }
    void submit_out(std::span<const std::uint8_t> bytes) override;
    falcon::Transfer out() const override { return out_.state; }
    bool take_in(falcon::Packet& packet) override;
    void close(std::span<const std::uint8_t> last_words) override { submit_out(last_words); }

  private:
    struct Slot {
        std::optional<std::uint64_t> id{};
        falcon::Transfer state = falcon::Transfer::Done;
    };
    void settle(Slot& slot);

    Wire& wire_;
    bool named_ = false;
    std::string serial_;
    std::optional<std::uint64_t> name_id_;
    Slot control_, out_;
    std::array<std::uint64_t, 8> reads_{};  // in the order they were asked for
    std::uint64_t failures_ = 0;
};

}  // namespace eddy::redir
