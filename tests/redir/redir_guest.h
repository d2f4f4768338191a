#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

struct usbredirparser;

namespace eddy::redir {

/// The guest's side of a usb-redir connection, in place of QEMU. Bytes in, bytes out, as RedirHost.
class RedirGuest {
  public:
    RedirGuest();
    ~RedirGuest();
    RedirGuest(const RedirGuest&) = delete;
    RedirGuest& operator=(const RedirGuest&) = delete;

    void receive(std::span<const std::uint8_t> bytes);
    std::vector<std::uint8_t> take_output();

    struct Device {
        std::uint8_t speed;
        std::uint16_t vendor, product, version;
    };
    struct Endpoint {
        std::uint8_t type, interval;
        std::uint16_t packet;
    };
    std::optional<Device> device;                // while there is one
    int disconnections = 0;                      //
    std::uint32_t interfaces = 0;                //
    std::uint8_t interface_class = 0;            // of the first
    std::map<std::uint8_t, Endpoint> endpoints;  // by address; all but those that are not there
    std::vector<std::string> complaints;         // of the library, about what the host sent
    std::vector<std::vector<std::uint8_t>> interrupts;

    /// What came back for a request.
    struct Answer {
        std::uint8_t status;
        std::size_t length;
        std::vector<std::uint8_t> data;
    };
    /// Each returns the id of the request.
    std::uint64_t control(std::uint8_t type, std::uint8_t request, std::uint16_t value, std::uint16_t index,
                          std::uint16_t length, std::span<const std::uint8_t> data = {});
    std::uint64_t bulk_in(std::uint8_t endpoint, std::uint32_t length);
    std::uint64_t bulk_out(std::uint8_t endpoint, std::span<const std::uint8_t> data);
    std::uint64_t interrupt_out(std::uint8_t endpoint, std::span<const std::uint8_t> data);
    std::uint64_t set_configuration(std::uint8_t number);
    std::uint64_t get_configuration();
    std::uint64_t set_alt_setting(std::uint8_t number);
    std::uint64_t start_interrupts(std::uint8_t endpoint);
    std::uint64_t stop_interrupts(std::uint8_t endpoint);
    void cancel(std::uint64_t id);
    void reset();
    /// Taken away from here; nothing while it is under way.
    std::optional<Answer> take(std::uint64_t id);

  private:
    struct Parser;

    usbredirparser* parser_;
    std::span<const std::uint8_t> input_;
    std::vector<std::uint8_t> output_;
    std::uint64_t next_id_ = 1;
    std::map<std::uint64_t, Answer> answers_;
};

}  // namespace eddy::redir
