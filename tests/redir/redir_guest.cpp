#include "tests/redir/redir_guest.h"

#include <usbredirparser.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>

namespace eddy::redir {

struct RedirGuest::Parser {
    static RedirGuest& guest(void* self) { return *static_cast<RedirGuest*>(self); }

    static void log(void* self, int level, const char* message) {
        if (level <= usbredirparser_warning) guest(self).complaints.emplace_back(message);
    }
    static int read(void* self, std::uint8_t* data, int count) {
        auto& input = guest(self).input_;
        const std::size_t size = std::min(static_cast<std::size_t>(count), input.size());
        std::copy_n(input.begin(), size, data);
        input = input.subspan(size);
        return static_cast<int>(size);
    }
    static int write(void* self, std::uint8_t* data, int count) {
        auto& output = guest(self).output_;
        output.insert(output.end(), data, data + count);
        return count;
    }
    static void hello(void*, usb_redir_hello_header*) {}
    static void connect(void* self, usb_redir_device_connect_header* d) {
        guest(self).device = Device{d->speed, d->vendor_id, d->product_id, d->device_version_bcd};
    }
    static void disconnect(void* self) {
        guest(self).device.reset();
        ++guest(self).disconnections;
    }
    static void interface_info(void* self, usb_redir_interface_info_header* info) {
        guest(self).interfaces = info->interface_count;
        guest(self).interface_class = info->interface_class[0];
    }
    static void ep_info(void* self, usb_redir_ep_info_header* info) {
        guest(self).endpoints.clear();
        for (std::uint8_t i = 0; i < 32; ++i)
            if (info->type[i] != usb_redir_type_invalid)
                guest(self).endpoints[static_cast<std::uint8_t>((i & 0x0F) | (i & 0x10) << 3)] = {
                    info->type[i], info->interval[i], info->max_packet_size[i]};
    }
    static void configuration(void* self, std::uint64_t id, usb_redir_configuration_status_header* answer) {
        guest(self).answers_[id] = {answer->status, 0, {answer->configuration}};
    }
    static void alt_setting(void* self, std::uint64_t id, usb_redir_alt_setting_status_header* answer) {
        guest(self).answers_[id] = {answer->status, 0, {answer->alt}};
    }
    static void interrupt_status(void* self, std::uint64_t id,
                                 usb_redir_interrupt_receiving_status_header* answer) {
        guest(self).answers_[id] = {answer->status, 0, {}};
    }
    static std::vector<std::uint8_t> take(void* self, std::uint8_t* data, int size) {
        std::vector<std::uint8_t> bytes;
        if (data) bytes.assign(data, data + size);
        usbredirparser_free_packet_data(guest(self).parser_, data);
        return bytes;
    }
    static void control(void* self, std::uint64_t id, usb_redir_control_packet_header* header,
                        std::uint8_t* data, int size) {
        guest(self).answers_[id] = {header->status, header->length, take(self, data, size)};
    }
    static void bulk(void* self, std::uint64_t id, usb_redir_bulk_packet_header* header, std::uint8_t* data,
                     int size) {
        const std::size_t length = header->length | static_cast<std::size_t>(header->length_high) << 16;
        guest(self).answers_[id] = {header->status, length, take(self, data, size)};
    }
    static void interrupt(void* self, std::uint64_t id, usb_redir_interrupt_packet_header* header,
                          std::uint8_t* data, int size) {
        auto bytes = take(self, data, size);
        if ((header->endpoint & 0x80) != 0)
            guest(self).interrupts.push_back(std::move(bytes));
        else
            guest(self).answers_[id] = {header->status, header->length, std::move(bytes)};
    }
};

RedirGuest::RedirGuest() : parser_(usbredirparser_create()) {
    if (!parser_) throw std::bad_alloc();
    parser_->priv = this;
    parser_->log_func = Parser::log;
    parser_->read_func = Parser::read;
    parser_->write_func = Parser::write;
    parser_->hello_func = Parser::hello;
    parser_->device_connect_func = Parser::connect;
    parser_->device_disconnect_func = Parser::disconnect;
    parser_->interface_info_func = Parser::interface_info;
    parser_->ep_info_func = Parser::ep_info;
    parser_->configuration_status_func = Parser::configuration;
    parser_->alt_setting_status_func = Parser::alt_setting;
    parser_->interrupt_receiving_status_func = Parser::interrupt_status;
    parser_->control_packet_func = Parser::control;
    parser_->bulk_packet_func = Parser::bulk;
    parser_->interrupt_packet_func = Parser::interrupt;
    // Those that QEMU has and that matter here.
    std::array<std::uint32_t, USB_REDIR_CAPS_SIZE> abilities{};
    for (const int ability :
         {usb_redir_cap_connect_device_version, usb_redir_cap_filter, usb_redir_cap_device_disconnect_ack,
          usb_redir_cap_ep_info_max_packet_size, usb_redir_cap_64bits_ids, usb_redir_cap_32bits_bulk_length,
          usb_redir_cap_bulk_receiving})
        usbredirparser_caps_set_cap(abilities.data(), ability);
    usbredirparser_init(parser_, "a test", abilities.data(), USB_REDIR_CAPS_SIZE, 0);
}

RedirGuest::~RedirGuest() {
    usbredirparser_destroy(parser_);
}

void RedirGuest::receive(std::span<const std::uint8_t> bytes) {
    input_ = bytes;
    while (!input_.empty())
        if (usbredirparser_do_read(parser_) != 0) complaints.emplace_back("not understood");
}

std::vector<std::uint8_t> RedirGuest::take_output() {
    usbredirparser_do_write(parser_);
    return std::exchange(output_, {});
}

std::uint64_t RedirGuest::control(std::uint8_t type, std::uint8_t request, std::uint16_t value,
                                  std::uint16_t index, std::uint16_t length,
                                  std::span<const std::uint8_t> data) {
    usb_redir_control_packet_header header{};
    header.endpoint = type & 0x80;
    header.requesttype = type;
    header.request = request;
    header.value = value;
    header.index = index;
    header.length = length;
    std::vector<std::uint8_t> bytes(data.begin(), data.end());
    usbredirparser_send_control_packet(parser_, next_id_, &header, bytes.empty() ? nullptr : bytes.data(),
                                       static_cast<int>(bytes.size()));
    return next_id_++;
}

std::uint64_t RedirGuest::bulk_in(std::uint8_t endpoint, std::uint32_t length) {
    usb_redir_bulk_packet_header header{};
    header.endpoint = endpoint;
    header.length = static_cast<std::uint16_t>(length & 0xFFFF);
    header.length_high = static_cast<std::uint16_t>(length >> 16);
    usbredirparser_send_bulk_packet(parser_, next_id_, &header, nullptr, 0);
    return next_id_++;
}

std::uint64_t RedirGuest::bulk_out(std::uint8_t endpoint, std::span<const std::uint8_t> data) {
    usb_redir_bulk_packet_header header{};
    header.endpoint = endpoint;
    header.length = static_cast<std::uint16_t>(data.size());
    std::vector<std::uint8_t> bytes(data.begin(), data.end());
    usbredirparser_send_bulk_packet(parser_, next_id_, &header, bytes.data(), static_cast<int>(bytes.size()));
    return next_id_++;
}

std::uint64_t RedirGuest::interrupt_out(std::uint8_t endpoint, std::span<const std::uint8_t> data) {
    usb_redir_interrupt_packet_header header{};
    header.endpoint = endpoint;
    header.length = static_cast<std::uint16_t>(data.size());
    std::vector<std::uint8_t> bytes(data.begin(), data.end());
    usbredirparser_send_interrupt_packet(parser_, next_id_, &header, bytes.data(),
                                         static_cast<int>(bytes.size()));
    return next_id_++;
}

std::uint64_t RedirGuest::set_configuration(std::uint8_t number) {
    usb_redir_set_configuration_header header{.configuration = number};
    usbredirparser_send_set_configuration(parser_, next_id_, &header);
    return next_id_++;
}

std::uint64_t RedirGuest::get_configuration() {
    usbredirparser_send_get_configuration(parser_, next_id_);
    return next_id_++;
}

std::uint64_t RedirGuest::set_alt_setting(std::uint8_t number) {
    usb_redir_set_alt_setting_header header{.interface = 0, .alt = number};
    usbredirparser_send_set_alt_setting(parser_, next_id_, &header);
    return next_id_++;
}

std::uint64_t RedirGuest::start_interrupts(std::uint8_t endpoint) {
    usb_redir_start_interrupt_receiving_header header{.endpoint = endpoint};
    usbredirparser_send_start_interrupt_receiving(parser_, next_id_, &header);
    return next_id_++;
}

std::uint64_t RedirGuest::stop_interrupts(std::uint8_t endpoint) {
    usb_redir_stop_interrupt_receiving_header header{.endpoint = endpoint};
    usbredirparser_send_stop_interrupt_receiving(parser_, next_id_, &header);
    return next_id_++;
}

void RedirGuest::cancel(std::uint64_t id) {
    usbredirparser_send_cancel_data_packet(parser_, id);
}

void RedirGuest::reset() {
    usbredirparser_send_reset(parser_);
}

std::optional<RedirGuest::Answer> RedirGuest::take(std::uint64_t id) {
    const auto found = answers_.find(id);
    if (found == answers_.end()) return std::nullopt;
    Answer answer = std::move(found->second);
    answers_.erase(found);
    return answer;
}

}  // namespace eddy::redir
