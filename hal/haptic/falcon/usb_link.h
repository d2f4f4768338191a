#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "hal/haptic/falcon/transport.h"

struct libusb_context;
struct libusb_device_handle;
struct libusb_transfer;

namespace eddy::falcon {

/// USB identity of the Falcon: FTDI's vendor number with a product number of its own (libnifalcon FalconComm.h).
/// Other devices with an FTDI chip have other product numbers and are never opened.
inline constexpr std::uint16_t kVendor = 0x0403;
inline constexpr std::uint16_t kProduct = 0xCB48;

/// The Falcon behind libusb-1.0, asynchronously. All transfers are allocated once; reads are kept queued, so
/// that a packet never waits for the host. Looks for the device while there is none.
///
/// Nothing of ours allocates once this is made. libusb itself takes one small block for each transfer and gives it
/// back when the transfer ends; finding, opening and closing a device are system calls that may take some
/// milliseconds, and happen only while no force can reach anybody.
class UsbLink final : public Transport {
  public:
    /// Only the Falcon with this serial string; empty: the first that can be had. Throws std::runtime_error if
    /// libusb does not start.
    explicit UsbLink(std::string serial);
    ~UsbLink() override;
    UsbLink(const UsbLink&) = delete;
    UsbLink& operator=(const UsbLink&) = delete;

    void poll(Instant now) override;
    bool present() const override { return stage_ == Stage::Open && !gone_; }
    std::string_view serial() const override;
    Obstacle obstacle() const override { return obstacle_; }
    std::uint64_t failures() const override { return failures_; }
    void submit_control(const ControlRequest& request) override;
    Transfer control() const override { return control_.state; }
    void submit_out(std::span<const std::uint8_t> bytes) override;
    Transfer out() const override { return out_.state; }
    bool take_in(Packet& packet) override;
    void close(std::span<const std::uint8_t> last_words) override;

  private:
    /// Searching: no device. Naming: open, asked for its serial string. Open: claimed, reads queued. Leaving: waits
    /// for its transfers to come back, then closes.
    enum class Stage { Searching, Naming, Open, Leaving };

    static constexpr std::size_t kSetupBytes = 8;
    static constexpr std::size_t kLongestString = 255;
    /// At one packet per millisecond and one more for each reply, what may come while the loop is 4 ms late. What
    /// does not fit stays in the chip's buffer.
    static constexpr std::size_t kReads = 8;

    struct Slot {
        UsbLink* owner = nullptr;
        libusb_transfer* transfer = nullptr;
        Transfer state = Transfer::Done;
        Instant deadline{0};
        std::array<std::uint8_t, kSetupBytes + kLongestString> bytes{};
    };

    static void on_finished(libusb_transfer* transfer);
    void finished(Slot& slot);

    void search();
    /// Asks for the string with this index.
    void ask_name(std::uint8_t index);
    void naming();
    void take_over();
    void upkeep();
    /// Closes what is open and goes on searching; at once if another device may be the one.
    void leave();
    void shut();

    bool submit(Slot& slot, Instant time_allowed);
    void submit_control(const ControlRequest& request, std::uint16_t length);
    void listen(Slot& slot);
    void cancel_if_late(Slot& slot) const;
    template <typename Done>
    void wait_for(Done done);

    const std::string wanted_;
    libusb_context* context_ = nullptr;
    libusb_device_handle* handle_ = nullptr;
    Stage stage_ = Stage::Searching;
    Obstacle obstacle_ = Obstacle::NotFound;
    Instant now_{0};
    Instant search_at_{0};
    std::size_t candidate_ = 0;  // Falcons passed over in this search
    bool claimed_ = false;
    bool gone_ = false;

    Slot control_;
    Slot out_;
    std::array<Slot, kReads> reads_;
    std::array<Slot*, kReads> filled_{};  // reads that hold a packet, oldest first
    std::size_t filled_count_ = 0;
    std::size_t under_way_ = 0;  // transfers that libusb has
    int failed_reads_ = 0;       // in a row
    int failed_writes_ = 0;      // in a row
    std::uint64_t failures_ = 0;

    std::array<char, kLongestString / 2> name_{};
    std::size_t name_size_ = 0;
};

/// Whether a Falcon is plugged in now, of whatever serial.
bool falcon_is_plugged_in();

}  // namespace eddy::falcon
