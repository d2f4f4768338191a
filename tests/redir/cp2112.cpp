#include "tests/redir/cp2112.h"

#include <algorithm>
#include <utility>

#include "tests/redir/command_line.h"

namespace eddy::redir {
namespace {

constexpr std::size_t kSetupBytes = 8;
constexpr std::size_t kDeviceBytes = 18, kConfigurationBytes = 9, kInterfaceBytes = 9, kHidBytes = 9;

// USB 2.0 specification, chapter 9; HID 1.11, chapter 7.
constexpr std::uint8_t kStandardIn = 0x80, kStandardInterfaceIn = 0x81, kClassOut = 0x21, kClassIn = 0xA1;
constexpr std::uint8_t kGetStatus = 0, kGetDescriptor = 6;
constexpr std::uint8_t kDeviceType = 1, kConfigurationType = 2, kStringType = 3, kHidType = 0x21,
                       kReportType = 0x22;
constexpr std::uint8_t kGetReport = 1, kSetReport = 9, kSetIdle = 10;
constexpr std::uint8_t kInput = 1, kOutput = 2, kFeature = 3;

/// Number, kind and length in bytes, without the number, of each report.
struct Report {
    std::uint8_t number, kind, bytes;
};
constexpr std::uint8_t kGpioConfig = 0x02, kGpioGet = 0x03, kGpioSet = 0x04, kVersion = 0x05,
                       kSmbusConfig = 0x06, kTransferStatusRequest = 0x15, kTransferStatus = 0x16,
                       kLockByte = 0x20, kUsbConfig = 0x21, kManufacturer = 0x22, kProduct = 0x23,
                       kSerial = 0x24;
constexpr Report kReports[] = {
    {0x01, kFeature, 1},                   // reset the device
    {kGpioConfig, kFeature, 4},            // directions, push-pull, special, clock divider
    {kGpioGet, kFeature, 1},               // levels
    {kGpioSet, kFeature, 2},               // values, which of them
    {kVersion, kFeature, 2},               // part number, version
    {kSmbusConfig, kFeature, 13},          //
    {0x10, kOutput, 3},                    // read
    {0x11, kOutput, 20},                   // write, then read
    {0x12, kOutput, 2},                    // send what was read
    {0x13, kInput, 63},                    // what was read
    {0x14, kOutput, 63},                   // write
    {kTransferStatusRequest, kOutput, 1},  //
    {kTransferStatus, kInput, 6},          //
    {0x17, kOutput, 1},                    // cancel
    {kLockByte, kFeature, 1},              //
    {kUsbConfig, kFeature, 9},             //
    {kManufacturer, kFeature, 62},         // strings
    {kProduct, kFeature, 62},              //
    {kSerial, kFeature, 62},               //
};

constexpr const char* kManufacturerText = "Silicon Laboratories";
constexpr const char* kProductText = "CP2112 HID USB-to-SMBus Bridge";
constexpr const char* kSerialText = "EMUL0001";

/// All reports are bytes of no further meaning (HID 1.11, 6.2.2): a vendor's usage page, one collection.
std::vector<std::uint8_t> report_descriptor() {
    std::vector<std::uint8_t> bytes{0x06, 0x00, 0xFF,              // usage page FF00
                                    0x09, 0x01, 0xA1, 0x01,        // usage 1; collection, application
                                    0x15, 0x00, 0x26, 0xFF, 0x00,  // from 0 to 255
                                    0x75, 0x08};                   // of eight bits
    for (const Report& report : kReports) {
        const auto item = static_cast<std::uint8_t>(report.kind == kInput    ? 0x81
                                                    : report.kind == kOutput ? 0x91
                                                                             : 0xB1);
        bytes.insert(bytes.end(), {0x85, report.number, 0x95, report.bytes, 0x09, 0x01, item, 0x02});
    }
    bytes.push_back(0xC0);
    return bytes;
}

std::vector<std::uint8_t> descriptors_with(std::size_t report_bytes) {
    return {// device: USB 2.0, release 1.00; strings 1 to 3; one configuration
            18, kDeviceType, 0x00, 0x02, 0, 0, 0, 64, 0xC4, 0x10, 0x90, 0xEA, 0x00, 0x01, 1, 2, 3, 1,
            // configuration: bus powered, 100 mA
            9, kConfigurationType, 41, 0, 1, 1, 0, 0x80, 50,
            // interface 0: HID, neither keyboard nor mouse
            9, 4, 0, 0, 2, 3, 0, 0, 0,
            // HID 1.11, one report descriptor
            9, kHidType, 0x11, 0x01, 0, 1, kReportType, static_cast<std::uint8_t>(report_bytes & 0xFF),
            static_cast<std::uint8_t>(report_bytes >> 8),
            // interrupt endpoints 81 and 01, 64 bytes, every millisecond
            7, 5, 0x81, 3, 64, 0, 1, 7, 5, 0x01, 3, 64, 0, 1};
}

std::vector<std::uint8_t> string_descriptor(std::string_view text) {
    std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(2 + 2 * text.size()), kStringType};
    for (const char letter : text) {
        bytes.push_back(static_cast<std::uint8_t>(letter));
        bytes.push_back(0);
    }
    return bytes;
}

const Report* report_with(std::uint8_t number) {
    const auto* found = std::find_if(std::begin(kReports), std::end(kReports),
                                     [number](const Report& report) { return report.number == number; });
    return found == std::end(kReports) ? nullptr : found;
}

constexpr std::uint8_t bit(unsigned line) {
    return static_cast<std::uint8_t>(1U << line);
}

}  // namespace

Cp2112::Cp2112() : descriptors_(descriptors_with(report_descriptor().size())) {
    begin_anew();
}

void Cp2112::begin_anew() {
    directions_ = push_pull_ = special_ = divider_ = 0;
    latch_ = 0xFF;
    // AN495: 100 kHz, address 2, no automatic reading, time-outs 0, no SCL low time-out, no retries
    smbus_config_ = {kSmbusConfig, 0, 0x01, 0x86, 0xA0, 0x02, 0, 0, 0, 0, 0, 0, 0, 0};
    to_say_.clear();
}

void Cp2112::poll(Instant now) {
    for (unsigned line = 0; line < kLines; ++line)
        if (released_at_[line] && now >= *released_at_[line]) {
            outside_ |= bit(line);
            released_at_[line].reset();
        }
    while (!waiting_.empty()) {
        Urb urb = waiting_.front();
        waiting_.pop_front();
        if (urb.pipe == Urb::Pipe::Out) {
            output_report(urb.buffer);
            urb.actual = urb.buffer.size();
            end(urb, Urb::Status::Done);
            continue;
        }
        const auto data = urb.buffer.subspan(kSetupBytes);
        const auto bytes = answer(urb.buffer.first(kSetupBytes), data);
        if (bytes && (urb.buffer[0] & 0x80U) != 0) {
            urb.actual = std::min(bytes->size(), data.size());
            std::copy_n(bytes->begin(), urb.actual, data.begin());
        } else if (bytes) {
            urb.actual = data.size();
        }
        end(urb, bytes ? Urb::Status::Done : Urb::Status::Stalled);
    }
    while (!to_say_.empty() && !reads_.empty()) {
        Urb urb = reads_.front();
        reads_.pop_front();
        urb.actual = std::min(to_say_.front().size(), urb.buffer.size());
        std::copy_n(to_say_.front().begin(), urb.actual, urb.buffer.begin());
        to_say_.pop_front();
        end(urb, Urb::Status::Done);
    }
}

void Cp2112::submit(const Urb& urb) {
    if (!plugged_in_) return end(urb, Urb::Status::Gone);
    (urb.pipe == Urb::Pipe::In ? reads_ : waiting_).push_back(urb);
}

bool Cp2112::cancel(const void* id) {
    for (auto* queue : {&waiting_, &reads_}) {
        const auto found =
            std::find_if(queue->begin(), queue->end(), [id](const Urb& urb) { return urb.id == id; });
        if (found == queue->end()) continue;
        end(*found, Urb::Status::Cancelled);
        queue->erase(found);
        return true;
    }
    return false;
}

std::optional<Urb> Cp2112::reap() {
    if (ended_.empty()) return std::nullopt;
    const Urb urb = ended_.front();
    ended_.pop_front();
    return urb;
}

void Cp2112::end(const Urb& urb, Urb::Status status) {
    ended_.push_back(urb);
    ended_.back().status = status;
}

void Cp2112::unplug() {
    plugged_in_ = false;
    for (auto* queue : {&waiting_, &reads_}) {
        for (const Urb& urb : *queue) end(urb, Urb::Status::Gone);
        queue->clear();
    }
    begin_anew();  // the bus was its supply
}

void Cp2112::reset() {
    begin_anew();
}

std::optional<Cp2112::Bytes> Cp2112::answer(std::span<const std::uint8_t> setup,
                                            std::span<const std::uint8_t> data) {
    const std::uint8_t type = setup[0], request = setup[1], number = setup[2], kind = setup[3];
    if (type == kStandardIn || type == kStandardInterfaceIn)
        return standard_answer(request, static_cast<std::uint16_t>(number | kind << 8));
    if (type == kClassOut && request == kSetIdle) return Bytes{};
    const Report* report = report_with(number);
    if (!report || report->kind != kind) return std::nullopt;
    if (type == kClassIn && request == kGetReport) return get_report(number);
    if (type != kClassOut || request != kSetReport) return std::nullopt;
    // The number comes first in the data, too.
    if (data.size() < report->bytes + 1U || data[0] != number || !set_report(number, data.subspan(1)))
        return std::nullopt;
    return Bytes{};
}

std::optional<Cp2112::Bytes> Cp2112::standard_answer(std::uint8_t request, std::uint16_t value) const {
    if (request == kGetStatus) return Bytes{0, 0};
    if (request != kGetDescriptor) return std::nullopt;
    const auto part = [this](std::size_t from, std::size_t size) {
        const auto bytes = std::span(descriptors_).subspan(from, size);
        return Bytes(bytes.begin(), bytes.end());
    };
    switch (value >> 8) {
        case kDeviceType:
            return part(0, kDeviceBytes);
        case kConfigurationType:
            return part(kDeviceBytes, descriptors_.size() - kDeviceBytes);
        case kHidType:
            return part(kDeviceBytes + kConfigurationBytes + kInterfaceBytes, kHidBytes);
        case kReportType:
            return report_descriptor();
        case kStringType:
            switch (value & 0xFF) {
                case 0:
                    return Bytes{4, kStringType, 0x09, 0x04};  // US English
                case 1:
                    return string_descriptor(kManufacturerText);
                case 2:
                    return string_descriptor(kProductText);
                case 3:
                    return string_descriptor(kSerialText);
                default:
                    return std::nullopt;
            }
        default:
            return std::nullopt;
    }
}

std::optional<Cp2112::Bytes> Cp2112::get_report(std::uint8_t number) const {
    const auto text = [number](std::string_view words) {
        Bytes bytes = string_descriptor(words);
        bytes.insert(bytes.begin(), number);
        bytes.resize(63);
        return bytes;
    };
    switch (number) {
        case kGpioConfig:
            return Bytes{number, directions_, push_pull_, special_, divider_};
        case kGpioGet:
            return Bytes{number, levels()};
        case kVersion:
            return Bytes{number, 0x0C, 0x02};
        case kSmbusConfig:
            return smbus_config_;
        case kLockByte:
            return Bytes{number, 0};  // its own memory is written and locked
        case kUsbConfig:
            return Bytes{number, 0xC4, 0x10, 0x90, 0xEA, 50, 0, 1, 0, 0};
        case kManufacturer:
            return text(kManufacturerText);
        case kProduct:
            return text(kProductText);
        case kSerial:
            return text(kSerialText);
        default:
            return std::nullopt;
    }
}

bool Cp2112::set_report(std::uint8_t number, std::span<const std::uint8_t> data) {
    switch (number) {
        case kGpioConfig:
            directions_ = data[0];
            push_pull_ = data[1];
            special_ = data[2];
            divider_ = data[3];
            return true;
        case kGpioSet:
            latch_ = static_cast<std::uint8_t>((latch_ & ~data[1]) | (data[0] & data[1]));
            return true;
        case kSmbusConfig:
            std::copy_n(data.begin(), smbus_config_.size() - 1, smbus_config_.begin() + 1);
            return true;
        default:
            return false;
    }
}

void Cp2112::output_report(std::span<const std::uint8_t> data) {
    if (data.empty() || data[0] != kTransferStatusRequest || to_say_.size() > 16) return;
    // AN495: complete with an error, and that is: address not acknowledged
    to_say_.push_back({kTransferStatus, 0x03, 0x00, 0, 0, 0, 0});
}

std::uint8_t Cp2112::levels() const {
    const unsigned driven = directions_ & push_pull_;   // to the latch
    const unsigned pulled = directions_ & ~push_pull_;  // down, or left to what is outside
    return static_cast<std::uint8_t>((latch_ & driven) | (latch_ & outside_ & pulled) |
                                     (outside_ & ~directions_ & 0xFFU));
}

std::string Cp2112::command(Instant now, std::string_view line) {
    const auto words = words_of(line);
    constexpr const char* kUsage =
        "not understood; low N, high N, press N MS (N from 0 to 7), unplug, plug, cut, quit";
    if (words.size() < 2) return kUsage;
    const auto which = index_in(words[1], kLines - 1);
    const bool press = words[0] == "press" && words.size() == 3;
    const auto time = press ? time_in(words[2]) : std::optional(Instant(0));
    if (!which || !time) return kUsage;
    if (press || (words[0] == "low" && words.size() == 2))
        outside_ &= static_cast<std::uint8_t>(~bit(*which));
    else if (words[0] == "high" && words.size() == 2)
        outside_ |= bit(*which);
    else
        return kUsage;
    released_at_[*which].reset();
    if (press) released_at_[*which] = now + *time;
    return {};
}

void Cp2112::report(Instant now, EventLog& log) {
    const std::array<std::uint8_t, 3> seen{directions_, levels(), outside_};
    if (reported_ == seen) return;
    reported_ = seen;
    nlohmann::ordered_json lines = nlohmann::ordered_json::array();
    for (unsigned line = 0; line < kLines; ++line) lines.push_back((levels() & bit(line)) != 0 ? 1 : 0);
    nlohmann::ordered_json driven = nlohmann::ordered_json::array();
    for (unsigned line = 0; line < kLines; ++line)
        if ((directions_ & bit(line)) != 0) driven.push_back(line);
    log.write(now, "lines", {{"levels", lines}, {"driven", driven}});
}

}  // namespace eddy::redir
