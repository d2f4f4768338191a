#include "hal/haptic/falcon/exchange.h"

namespace eddy::falcon {
namespace {

// Both: which of the two empties the side that holds our reply has been named both ways round in FTDI
// libraries.
constexpr ControlRequest kPurge[] = {purge_receiver(), purge_transmitter()};

}  // namespace

void Exchange::reset() {
    finder_.clear();
    step_ = Step::Free;
    misses_ = timely_ = 0;
    doubtful_ = false;
}

std::optional<Reply> Exchange::poll(Instant now) {
    std::optional<Reply> newest;
    int replies = 0;
    Packet packet;
    while (transport_.take_in(packet)) {
        const Payload payload = strip_status(packet);
        if (payload.line_fault) ++line_faults_;
        for (const std::uint8_t byte : payload.bytes) {
            const auto frame = finder_.push(byte);
            if (!frame) continue;
            newest = decode_reply(*frame);
            ++replies;
            reply_arrived_at_ = packet.arrived_at;
        }
    }
    if (replies > 0) answered(replies, now);
    if (step_ == Step::Quiet && now >= deadline_) {
        step_ = Step::Free;
        doubtful_ = false;
    }
    if (step_ == Step::Waiting && now >= deadline_) {
        ++misses_;
        timely_ = 0;
        doubtful_ = true;
        finder_.clear();
        purge_.start(kPurge);
        step_ = Step::Purging;
        deadline_ = now + kReplyTime;
    }
    if (step_ == Step::Purging && (purge_.poll(transport_) != Progress::Working || now >= deadline_))
        step_ = Step::Free;
    return newest;
}

void Exchange::answered(int replies, Instant now) {
    misses_ = 0;
    if (step_ == Step::Purging) return;
    const int asked_for = step_ == Step::Waiting ? 1 : 0;
    if (doubtful_ || replies > asked_for) {
        doubtful_ = true;
        timely_ = 0;
        step_ = Step::Quiet;
        deadline_ = now + kQuietTime;
    } else {
        step_ = Step::Free;
        ++timely_;
    }
}

void Exchange::send(const Command& command, Instant now) {
    transport_.submit_out(encode(command));
    step_ = Step::Waiting;
    deadline_ = now + kReplyTime;
}

}  // namespace eddy::falcon
