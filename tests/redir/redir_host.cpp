#include "tests/redir/redir_host.h"

#include <usbredirparser.h>

#include <algorithm>
#include <array>
#include <new>
#include <utility>

namespace eddy::redir {
namespace {

// What a guest may ask for at once. A device of 64-byte packets needs far less.
constexpr std::size_t kMostBytes = 1 << 20;
constexpr std::size_t kMostRequests = 256;

constexpr std::size_t kSetupBytes = 8;
constexpr std::size_t kDeviceBytes = 18;
constexpr std::uint8_t kIn = 0x80;
// USB 2.0 specification, table 9-5.
constexpr std::uint8_t kInterfaceType = 4, kEndpointType = 5;

constexpr std::uint8_t kSuccess = usb_redir_success;
constexpr std::uint8_t kInvalid = usb_redir_inval;

std::uint8_t status_of(Urb::Status status) {
    switch (status) {
        case Urb::Status::Pending:
        case Urb::Status::Done:
            return kSuccess;
        case Urb::Status::Stalled:
            return usb_redir_stall;
        case Urb::Status::Overflowed:
            return usb_redir_babble;
        case Urb::Status::Cancelled:
            return usb_redir_cancelled;
        case Urb::Status::Garbled:
        case Urb::Status::Gone:
            return usb_redir_ioerror;
    }
    return usb_redir_ioerror;
}

std::uint16_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
    return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
}
std::uint8_t low(std::size_t number) {
    return static_cast<std::uint8_t>(number & 0xFF);
}
std::uint8_t high(std::size_t number) {
    return static_cast<std::uint8_t>(number >> 8 & 0xFF);
}

/// Where the protocol's tables keep an endpoint.
std::size_t place_of(std::uint8_t endpoint) {
    return (endpoint & 0x0FU) | ((endpoint & kIn) != 0 ? 0x10U : 0U);
}

/// The tables of interfaces and endpoints that the protocol has beside the descriptors.
struct Tables {
    usb_redir_interface_info_header interfaces{};
    usb_redir_ep_info_header endpoints{};
};

Tables tables_of(std::span<const std::uint8_t> descriptors) {
    Tables tables;
    std::fill_n(tables.endpoints.type, 32, usb_redir_type_invalid);
    tables.endpoints.type[0] = tables.endpoints.type[0x10] = usb_redir_type_control;
    tables.endpoints.max_packet_size[0] = tables.endpoints.max_packet_size[0x10] = descriptors[7];
    std::uint8_t interface = 0;
    for (auto rest = descriptors.subspan(kDeviceBytes); rest.size() >= 2 && rest[0] >= 2;
         rest = rest.subspan(std::min<std::size_t>(rest[0], rest.size()))) {
        if (rest[1] == kInterfaceType) {
            const auto i = tables.interfaces.interface_count++;
            interface = rest[2];
            tables.interfaces.interface[i] = interface;
            tables.interfaces.interface_class[i] = rest[5];
            tables.interfaces.interface_subclass[i] = rest[6];
            tables.interfaces.interface_protocol[i] = rest[7];
        } else if (rest[1] == kEndpointType) {
            const std::size_t i = place_of(rest[2]);
            tables.endpoints.type[i] = rest[3] & 3U;
            tables.endpoints.interface[i] = interface;
            tables.endpoints.max_packet_size[i] = word(rest, 4);
            tables.endpoints.interval[i] = rest[6];
        }
    }
    return tables;
}

}  // namespace

struct RedirHost::Request {
    Kind kind;
    std::uint64_t id = 0;                           // the guest's name for it
    usb_redir_control_packet_header control{};      // as asked for
    usb_redir_bulk_packet_header bulk{};            //
    usb_redir_interrupt_packet_header interrupt{};  //
    std::vector<std::uint8_t> buffer{};
    std::size_t actual = 0;
};

/// The library's callbacks. A guest speaks when it likes: what it may not say now is left unheard, as after a
/// disconnection that it has not noticed yet.
struct RedirHost::Parser {
    static RedirHost& host(void* self) { return *static_cast<RedirHost*>(self); }

    static void log(void* self, int level, const char* message) {
        if (level == usbredirparser_error) host(self).refuse(message);
    }
    static int read(void* self, std::uint8_t* data, int count) {
        auto& input = host(self).input_;
        const std::size_t size = std::min(static_cast<std::size_t>(count), input.size());
        std::copy_n(input.begin(), size, data);
        input = input.subspan(size);
        return static_cast<int>(size);
    }
    static int write(void* self, std::uint8_t* data, int count) {
        auto& output = host(self).output_;
        output.insert(output.end(), data, data + count);
        return count;
    }

    static void hello(void* self, usb_redir_hello_header*) {
        host(self).greeted_ = true;
        host(self).show_device();
    }
    static void disconnect_ack(void* self) {
        host(self).leaving_ = false;
        host(self).show_device();
    }
    static void reset(void* self) {
        RedirHost& me = host(self);
        if (!me.attached_) return;
        me.cancel_requests();
        me.peer_.reset();
        me.configuration_ = 1;
    }

    static void set_configuration(void* self, std::uint64_t id, usb_redir_set_configuration_header* wanted) {
        RedirHost& me = host(self);
        if (!me.attached_) return;
        const std::uint8_t value_in_descriptor = me.peer_.descriptors()[kDeviceBytes + 5];
        const bool known = wanted->configuration == 0 || wanted->configuration == value_in_descriptor;
        if (known) {
            me.cancel_requests();
            me.configuration_ = wanted->configuration;
        }
        configuration_status(me, id, known ? kSuccess : kInvalid);
    }
    static void get_configuration(void* self, std::uint64_t id) {
        if (host(self).attached_) configuration_status(host(self), id, kSuccess);
    }
    static void configuration_status(RedirHost& me, std::uint64_t id, std::uint8_t status) {
        usb_redir_configuration_status_header answer{.status = status, .configuration = me.configuration_};
        usbredirparser_send_configuration_status(me.parser_, id, &answer);
    }
    // Each interface has one setting.
    static void set_alt_setting(void* self, std::uint64_t id, usb_redir_set_alt_setting_header* wanted) {
        if (!host(self).attached_) return;
        usb_redir_alt_setting_status_header answer{
            .status = wanted->alt == 0 ? kSuccess : kInvalid, .interface = wanted->interface, .alt = 0};
        usbredirparser_send_alt_setting_status(host(self).parser_, id, &answer);
    }
    static void get_alt_setting(void* self, std::uint64_t id, usb_redir_get_alt_setting_header* wanted) {
        if (!host(self).attached_) return;
        usb_redir_alt_setting_status_header answer{
            .status = kSuccess, .interface = wanted->interface, .alt = 0};
        usbredirparser_send_alt_setting_status(host(self).parser_, id, &answer);
    }

    static void control(void* self, std::uint64_t id, usb_redir_control_packet_header* header,
                        std::uint8_t* data, int size) {
        auto request =
            std::make_unique<Request>(Request{.kind = Kind::Control, .id = id, .control = *header});
        request->buffer = {header->requesttype, header->request,     low(header->value),
                           high(header->value), low(header->index),  high(header->index),
                           low(header->length), high(header->length)};
        take(self, *request, data, size);
        request->buffer.resize(kSetupBytes + header->length);
        if (host(self).attached_) host(self).submit(std::move(request));
    }
    static void bulk(void* self, std::uint64_t id, usb_redir_bulk_packet_header* header, std::uint8_t* data,
                     int size) {
        const bool in = (header->endpoint & kIn) != 0;
        auto request = std::make_unique<Request>(
            Request{.kind = in ? Kind::BulkIn : Kind::BulkOut, .id = id, .bulk = *header});
        take(self, *request, data, size);
        if (!host(self).attached_) return;
        const std::size_t wanted = header->length | static_cast<std::size_t>(header->length_high) << 16;
        if (wanted > kMostBytes) return host(self).answer(*request, kInvalid);
        request->buffer.resize(wanted);
        host(self).submit(std::move(request));
    }
    static void interrupt(void* self, std::uint64_t id, usb_redir_interrupt_packet_header* header,
                          std::uint8_t* data, int size) {
        auto request =
            std::make_unique<Request>(Request{.kind = Kind::InterruptOut, .id = id, .interrupt = *header});
        take(self, *request, data, size);
        if (host(self).attached_) host(self).submit(std::move(request));
    }
    static void iso(void* self, std::uint64_t, usb_redir_iso_packet_header*, std::uint8_t* data, int) {
        usbredirparser_free_packet_data(host(self).parser_, data);
    }
    static void take(void* self, Request& request, std::uint8_t* data, int size) {
        if (data) request.buffer.insert(request.buffer.end(), data, data + size);
        usbredirparser_free_packet_data(host(self).parser_, data);
    }
    static void cancel(void* self, std::uint64_t id) {
        RedirHost& me = host(self);
        for (const auto& request : me.requests_)
            if (request->id == id && request->kind != Kind::InterruptRead) {
                me.peer_.cancel(request.get());
                return;
            }
    }

    static void start_interrupt(void* self, std::uint64_t id,
                                usb_redir_start_interrupt_receiving_header* wanted) {
        RedirHost& me = host(self);
        if (!me.attached_) return;
        const Tables tables = tables_of(me.peer_.descriptors());
        const std::size_t place = place_of(wanted->endpoint);
        const bool known =
            (wanted->endpoint & kIn) != 0 && tables.endpoints.type[place] == usb_redir_type_interrupt;
        interrupt_status(me, id, wanted->endpoint, known ? kSuccess : kInvalid);
        if (!known || std::any_of(me.requests_.begin(), me.requests_.end(),
                                  [](const auto& r) { return r->kind == Kind::InterruptRead; }))
            return;
        auto request = std::make_unique<Request>(Request{.kind = Kind::InterruptRead});
        request->interrupt.endpoint = wanted->endpoint;
        request->buffer.resize(tables.endpoints.max_packet_size[place]);
        me.submit(std::move(request));
    }
    static void stop_interrupt(void* self, std::uint64_t id,
                               usb_redir_stop_interrupt_receiving_header* wanted) {
        RedirHost& me = host(self);
        if (!me.attached_) return;
        for (const auto& request : me.requests_)
            if (request->kind == Kind::InterruptRead) {
                me.peer_.cancel(request.get());
                break;
            }
        interrupt_status(me, id, wanted->endpoint, kSuccess);
    }
    static void interrupt_status(RedirHost& me, std::uint64_t id, std::uint8_t endpoint,
                                 std::uint8_t status) {
        usb_redir_interrupt_receiving_status_header answer{.status = status, .endpoint = endpoint};
        usbredirparser_send_interrupt_receiving_status(me.parser_, id, &answer);
    }
    static void start_iso(void* self, std::uint64_t id, usb_redir_start_iso_stream_header* wanted) {
        usb_redir_iso_stream_status_header answer{.status = kInvalid, .endpoint = wanted->endpoint};
        usbredirparser_send_iso_stream_status(host(self).parser_, id, &answer);
    }
    static void stop_iso(void* self, std::uint64_t id, usb_redir_stop_iso_stream_header* wanted) {
        usb_redir_iso_stream_status_header answer{.status = kSuccess, .endpoint = wanted->endpoint};
        usbredirparser_send_iso_stream_status(host(self).parser_, id, &answer);
    }
};

RedirHost::RedirHost(UsbPeer& peer, bool plugged_in)
    : peer_(peer), parser_(usbredirparser_create()), plugged_in_(plugged_in) {
    if (!parser_) throw std::bad_alloc();
    parser_->priv = this;
    parser_->log_func = Parser::log;
    parser_->read_func = Parser::read;
    parser_->write_func = Parser::write;
    parser_->hello_func = Parser::hello;
    parser_->device_disconnect_ack_func = Parser::disconnect_ack;
    parser_->reset_func = Parser::reset;
    parser_->set_configuration_func = Parser::set_configuration;
    parser_->get_configuration_func = Parser::get_configuration;
    parser_->set_alt_setting_func = Parser::set_alt_setting;
    parser_->get_alt_setting_func = Parser::get_alt_setting;
    parser_->control_packet_func = Parser::control;
    parser_->bulk_packet_func = Parser::bulk;
    parser_->interrupt_packet_func = Parser::interrupt;
    parser_->iso_packet_func = Parser::iso;
    parser_->cancel_data_packet_func = Parser::cancel;
    parser_->start_interrupt_receiving_func = Parser::start_interrupt;
    parser_->stop_interrupt_receiving_func = Parser::stop_interrupt;
    parser_->start_iso_stream_func = Parser::start_iso;
    parser_->stop_iso_stream_func = Parser::stop_iso;
    // No bulk streams, and no bulk receiving: bytes come when the guest has asked for them, as on a bus. The library
    // itself turns down packets of what was not promised.
    std::array<std::uint32_t, USB_REDIR_CAPS_SIZE> abilities{};
    for (const int ability :
         {usb_redir_cap_connect_device_version, usb_redir_cap_device_disconnect_ack,
          usb_redir_cap_ep_info_max_packet_size, usb_redir_cap_64bits_ids, usb_redir_cap_32bits_bulk_length})
        usbredirparser_caps_set_cap(abilities.data(), ability);
    usbredirparser_init(parser_, "eddy " EDDY_VERSION, abilities.data(), USB_REDIR_CAPS_SIZE,
                        usbredirparser_fl_usb_host);
}

RedirHost::~RedirHost() {
    if (attached_) {
        forget_requests();
        peer_.unplug();
    }
    usbredirparser_destroy(parser_);
}

bool RedirHost::receive(std::span<const std::uint8_t> bytes) {
    input_ = bytes;
    while (complaint_.empty() && !input_.empty())
        if (usbredirparser_do_read(parser_) != 0) refuse("not understood");
    return complaint_.empty();
}

void RedirHost::poll(Instant now) {
    peer_.poll(now);
    collect();
}

std::vector<std::uint8_t> RedirHost::take_output() {
    usbredirparser_do_write(parser_);
    return std::exchange(output_, {});
}

void RedirHost::plug_in() {
    plugged_in_ = true;
    show_device();
}

void RedirHost::unplug() {
    plugged_in_ = false;
    if (!std::exchange(attached_, false)) return;
    forget_requests();
    peer_.unplug();
    usbredirparser_send_device_disconnect(parser_);
    leaving_ = usbredirparser_peer_has_cap(parser_, usb_redir_cap_device_disconnect_ack) != 0;
}

void RedirHost::show_device() {
    if (!greeted_ || !plugged_in_ || attached_ || leaving_) return;
    attached_ = true;
    configuration_ = 1;
    peer_.plug_in();
    const auto d = peer_.descriptors();
    Tables tables = tables_of(d);
    usbredirparser_send_ep_info(parser_, &tables.endpoints);
    usbredirparser_send_interface_info(parser_, &tables.interfaces);
    usb_redir_device_connect_header device{.speed = usb_redir_speed_full,
                                           .device_class = d[4],
                                           .device_subclass = d[5],
                                           .device_protocol = d[6],
                                           .vendor_id = word(d, 8),
                                           .product_id = word(d, 10),
                                           .device_version_bcd = word(d, 12)};
    usbredirparser_send_device_connect(parser_, &device);
}

void RedirHost::submit(std::unique_ptr<Request> request) {
    if (requests_.size() >= kMostRequests) return answer(*request, kInvalid);
    const auto pipe = [&request] {
        switch (request->kind) {
            case Kind::Control:
                return Urb::Pipe::Control;
            case Kind::BulkIn:
            case Kind::InterruptRead:
                return Urb::Pipe::In;
            case Kind::BulkOut:
            case Kind::InterruptOut:
                break;
        }
        return Urb::Pipe::Out;
    }();
    requests_.push_back(std::move(request));
    Request& under_way = *requests_.back();
    peer_.submit({.id = &under_way, .pipe = pipe, .buffer = under_way.buffer});
}

void RedirHost::collect() {
    while (const auto ended = peer_.reap()) {
        const auto found = std::find_if(requests_.begin(), requests_.end(),
                                        [&ended](const auto& request) { return request.get() == ended->id; });
        if (found == requests_.end()) continue;
        auto request = std::move(*found);
        requests_.erase(found);
        request->actual = ended->actual;
        answer(*request, status_of(ended->status));
        if (request->kind == Kind::InterruptRead && ended->status == Urb::Status::Done)
            submit(std::move(request));
    }
}

void RedirHost::answer(Request& request, std::uint8_t status) {
    const auto size = static_cast<int>(request.actual);
    switch (request.kind) {
        case Kind::Control: {
            const bool in = (request.control.endpoint & kIn) != 0;
            request.control.status = status;
            request.control.length = static_cast<std::uint16_t>(size);
            usbredirparser_send_control_packet(parser_, request.id, &request.control,
                                               in && size > 0 ? request.buffer.data() + kSetupBytes : nullptr,
                                               in ? size : 0);
            break;
        }
        case Kind::BulkIn:
        case Kind::BulkOut: {
            const bool in = request.kind == Kind::BulkIn;
            request.bulk.status = status;
            request.bulk.length = static_cast<std::uint16_t>(size & 0xFFFF);
            request.bulk.length_high = static_cast<std::uint16_t>(size >> 16);
            usbredirparser_send_bulk_packet(parser_, request.id, &request.bulk,
                                            in && size > 0 ? request.buffer.data() : nullptr, in ? size : 0);
            break;
        }
        case Kind::InterruptOut:
            request.interrupt.status = status;
            request.interrupt.length = static_cast<std::uint16_t>(size);
            usbredirparser_send_interrupt_packet(parser_, request.id, &request.interrupt, nullptr, 0);
            break;
        case Kind::InterruptRead:
            if (status == usb_redir_cancelled) break;  // stopped
            request.interrupt.status = status;
            request.interrupt.length = static_cast<std::uint16_t>(size);
            usbredirparser_send_interrupt_packet(parser_, interrupts_++, &request.interrupt,
                                                 size > 0 ? request.buffer.data() : nullptr, size);
            break;
    }
}

void RedirHost::cancel_requests() {
    for (const auto& request : requests_) peer_.cancel(request.get());
    collect();
}

void RedirHost::forget_requests() {
    for (const auto& request : requests_) peer_.cancel(request.get());
    while (peer_.reap()) {
    }
    requests_.clear();
}

void RedirHost::refuse(std::string why) {
    if (complaint_.empty()) complaint_ = std::move(why);
}

}  // namespace eddy::redir
