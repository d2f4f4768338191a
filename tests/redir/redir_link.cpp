#include "tests/redir/redir_link.h"

#include <algorithm>

namespace eddy::redir {
namespace {

constexpr std::uint8_t kBulkIn = 0x81, kBulkOut = 0x02;

}  // namespace

void RedirLink::poll(Instant now) {
    if (now > wire_.now) wire_.run(now - wire_.now);
    if (!wire_.guest.device) {
        named_ = false;
        name_id_.reset();
        control_ = out_ = {};
        return;
    }
    if (named_) {
        settle(control_);
        settle(out_);
        return;
    }
    if (!name_id_) name_id_ = wire_.guest.control(0x80, 6, 0x0303, 0x0409, 255);
    const auto name = wire_.guest.take(*name_id_);
    if (!name) return;
    serial_.clear();
    for (std::size_t i = 2; i + 1 < name->data.size(); i += 2) serial_ += static_cast<char>(name->data[i]);
    named_ = true;
    for (auto& read : reads_) read = wire_.guest.bulk_in(kBulkIn, falcon::kPacketBytes);
}

void RedirLink::settle(Slot& slot) {
    if (!slot.id) return;
    const auto answer = wire_.guest.take(*slot.id);
    if (!answer) return;
    slot = {std::nullopt, answer->status == 0 ? falcon::Transfer::Done : falcon::Transfer::Failed};
    failures_ += answer->status == 0 ? 0 : 1;
}

void RedirLink::submit_control(const falcon::ControlRequest& request) {
    control_ = {wire_.guest.control(request.type, request.request, request.value, request.index, 0),
                falcon::Transfer::Pending};
}

void RedirLink::submit_out(std::span<const std::uint8_t> bytes) {
    out_ = {wire_.guest.bulk_out(kBulkOut, bytes), falcon::Transfer::Pending};
}

bool RedirLink::take_in(falcon::Packet& packet) {
    if (!named_) return false;
    const auto answer = wire_.guest.take(reads_[0]);
    if (!answer) return false;
    std::rotate(reads_.begin(), reads_.begin() + 1, reads_.end());
    reads_.back() = wire_.guest.bulk_in(kBulkIn, falcon::kPacketBytes);
    if (answer->status != 0) {
        ++failures_;
        return false;
    }
    packet.size = answer->data.size();
    std::copy(answer->data.begin(), answer->data.end(), packet.bytes.begin());
    packet.arrived_at = wire_.now;
    return true;
}

}  // namespace eddy::redir
