#include "hal/haptic/falcon/boot.h"

#include <algorithm>
#include <array>

namespace eddy::falcon {
namespace {

using namespace std::chrono_literals;

// The PIC's question and answer (libnifalcon FalconCommLibUSB.cpp). Some hosts see a 00 before the answer.
constexpr std::array<std::uint8_t, 3> kCall{0x0A, 0x43, 0x0D};
constexpr std::array<std::uint8_t, 4> kAnswer{0x0A, 0x44, 0x2C, 0x0D};
// The letter from which the boot ROM measures the rate, and which it echoes; some drivers saw 13 41.
constexpr std::array<std::uint8_t, 1> kRateLetter{0x41};

// The PIC answers when DTR rises. Latency 16 ms: at 9600 Bd question and answer take 7.3 ms, so one packet
// holds it all.
constexpr ControlRequest kConfigure[] = {
    purge_receiver(),  purge_transmitter(), set_latency(16), baud_9600(),   eight_bits_no_parity_one_stop(),
    no_flow_control(), set_rts(false),      set_dtr(false),  set_dtr(true),
};
// DTR low releases the DSP. The purge drops late answers of the PIC.
constexpr ControlRequest kSwitchOver[] = {set_dtr(false), baud_142857(), purge_receiver(),
                                          purge_transmitter()};

constexpr std::size_t kChunk =
    62;  // what fits into one packet of the echo: a larger chunk waits for the latency timer
constexpr int kMaxCalls = 20;
constexpr Instant kRequestsTime = 1s;   // libnifalcon's time-out for control requests
constexpr Instant kAnswerTime = 100ms;  // several latency periods
constexpr Instant kEchoTime = 200ms;    // a chunk takes 5 ms and at most one latency period
constexpr Instant kSettleTime = 20ms;   // for the DSP to start its program; a guess on the safe side

}  // namespace

void Boot::start(Instant now) {
    calls_ = 0;
    requests_.start(kConfigure);
    enter(Step::Configuring, now + kRequestsTime);
}

Progress Boot::poll(Instant now) {
    switch (step_) {
        case Step::Configuring:
            return configure(now);
        case Step::Calling:
            return call(now);
        case Step::Switching:
            return switch_over(now);
        case Step::FindingRate:
            return find_rate(now);
        case Step::Uploading:
            return upload(now);
        case Step::Settling:
            return settle(now);
    }
    return Progress::Failed;
}

void Boot::enter(Step step, Instant deadline) {
    step_ = step;
    deadline_ = deadline;
}

template <typename Take>
bool Boot::take_bytes(Take take) {
    Packet packet;
    while (transport_.take_in(packet))
        for (const std::uint8_t byte : strip_status(packet).bytes)
            if (!take(byte)) return false;
    return true;
}

Progress Boot::configure(Instant now) {
    const Progress progress = requests_.poll(transport_);
    if (progress == Progress::Done && transport_.out() != Transfer::Pending) {
        ask(now);
        return Progress::Working;
    }
    return waiting(now, progress);
}

void Boot::ask(Instant now) {
    ++calls_;
    matched_ = 0;
    transport_.submit_out(kCall);
    enter(Step::Calling, now + kAnswerTime);
}

Progress Boot::call(Instant now) {
    const bool waiting = take_bytes([this](std::uint8_t byte) {
        matched_ = byte == kAnswer[matched_] ? matched_ + 1 : (byte == kAnswer[0] ? 1 : 0);
        return matched_ < kAnswer.size();
    });
    if (!waiting) {
        requests_.start(kSwitchOver);
        enter(Step::Switching, now + kRequestsTime);
    } else if (now > deadline_) {
        if (calls_ == kMaxCalls || transport_.out() != Transfer::Done) return Progress::Failed;
        ask(now);
    }
    return Progress::Working;
}

Progress Boot::switch_over(Instant now) {
    const Progress progress = requests_.poll(transport_);
    if (progress == Progress::Done && transport_.out() != Transfer::Pending) {
        take_bytes([](std::uint8_t) { return true; });
        transport_.submit_out(kRateLetter);
        enter(Step::FindingRate, now + kAnswerTime);
        return Progress::Working;
    }
    return waiting(now, progress);
}

/// What a list of requests makes of this step.
Progress Boot::waiting(Instant now, Progress requests) const {
    return requests == Progress::Failed || now > deadline_ ? Progress::Failed : Progress::Working;
}

Progress Boot::find_rate(Instant now) {
    if (!take_bytes([](std::uint8_t byte) { return byte != kRateLetter[0]; })) {
        sent_ = echoed_ = 0;
        enter(Step::Uploading, now + kEchoTime);
        send_chunk(now);
        return Progress::Working;
    }
    return now > deadline_ ? Progress::Failed : Progress::Working;
}

void Boot::send_chunk(Instant now) {
    const std::size_t size = std::min(kChunk, image_.size() - sent_);
    transport_.submit_out(image_.subspan(sent_, size));
    sent_ += size;
    deadline_ = now + kEchoTime;
}

Progress Boot::upload(Instant now) {
    const bool as_sent =
        take_bytes([this](std::uint8_t byte) { return echoed_ < sent_ && byte == image_[echoed_++]; });
    if (!as_sent) ++wrong_echoes_;
    if (!as_sent || now > deadline_) return Progress::Failed;
    if (echoed_ == image_.size())
        enter(Step::Settling, now + kSettleTime);
    else if (echoed_ == sent_ && transport_.out() == Transfer::Done)
        send_chunk(now);
    return Progress::Working;
}

Progress Boot::settle(Instant now) const {
    return now > deadline_ ? Progress::Done : Progress::Working;
}

}  // namespace eddy::falcon
