#include "tests/fuzz/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "firmware/haptic/flight_file.h"
#include "firmware/haptic/flight_rerun.h"
#include "firmware/input_error.h"
#include "hal/haptic/falcon/exchange.h"
#include "hal/haptic/falcon/firmware_image.h"
#include "hal/haptic/falcon/protocol.h"

namespace eddy {
namespace {

using namespace falcon;

/// An assertion that also holds in a release build.
void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "fuzz: not so: %s\n", what);
    std::abort();
}

/// Hands out the input piece by piece.
class Input {
  public:
    explicit Input(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
    bool empty() const { return rest_.empty(); }
    std::uint8_t byte() {
        if (rest_.empty()) return 0;
        const std::uint8_t first = rest_.front();
        rest_ = rest_.subspan(1);
        return first;
    }
    std::span<const std::uint8_t> bytes(std::size_t most) {
        const auto piece = rest_.first(std::min(most, rest_.size()));
        rest_ = rest_.subspan(piece.size());
        return piece;
    }

  private:
    std::span<const std::uint8_t> rest_;
};

/// A device of which the input decides everything.
class Whimsical final : public Transport {
  public:
    explicit Whimsical(Input& input) : input_(input) {}

    void poll(Instant) override {
        const std::uint8_t whim = input_.byte();
        if (control_ == Transfer::Pending && (whim & 1) != 0)
            control_ = (whim & 2) != 0 ? Transfer::Done : Transfer::Failed;
        if (out_ == Transfer::Pending && (whim & 4) != 0)
            out_ = (whim & 8) != 0 ? Transfer::Done : Transfer::Failed;
        packets_ = whim >> 6;
    }
    bool present() const override { return true; }
    std::string_view serial() const override { return "WHIM"; }
    Obstacle obstacle() const override { return Obstacle::NotFound; }
    std::uint64_t failures() const override { return 0; }
    void submit_control(const ControlRequest&) override {
        require(control_ != Transfer::Pending, "a control request waits for the one before");
        control_ = Transfer::Pending;
    }
    Transfer control() const override { return control_; }
    void submit_out(std::span<const std::uint8_t> bytes) override {
        require(out_ != Transfer::Pending, "a command waits for the one before");
        require(bytes.size() == kFrameBytes, "a command is a frame");
        out_ = Transfer::Pending;
    }
    Transfer out() const override { return out_; }
    bool take_in(Packet& packet) override {
        if (packets_ == 0) return false;
        --packets_;
        const auto content = input_.bytes(input_.byte() % (kPacketBytes + 1));
        packet.size = content.size();
        std::copy(content.begin(), content.end(), packet.bytes.begin());
        return true;
    }
    void close(std::span<const std::uint8_t>) override {}

  private:
    Input& input_;
    Transfer control_ = Transfer::Done;
    Transfer out_ = Transfer::Done;
    int packets_ = 0;
};

}  // namespace

void fuzz_frames(std::span<const std::uint8_t> input) {
    FrameFinder finder;
    std::size_t found = 0;
    for (const std::uint8_t byte : input) {
        const auto frame = finder.push(byte);
        if (!frame) continue;
        ++found;
        const Reply reply = decode_reply(*frame);
        Frame again = encode(reply);
        again[14] = (*frame)[14];  // of no known meaning
        require(again == *frame, "a reply writes back as it was read");
        for (const int motor : decode_command(encode(decode_command(*frame))).motors)
            require(std::abs(motor) <= kMaxMotor, "no command goes beyond the motors' range");
    }
    const std::size_t accounted = found * kFrameBytes + finder.dropped();
    require(accounted <= input.size() && input.size() - accounted < kFrameBytes,
            "no byte is lost or counted twice");
}

void fuzz_firmware(std::span<const std::uint8_t> input) {
    const auto problem = problem_in_firmware(input);
    if (problem) return require(!problem->empty(), "a problem has words");
    require(input.size() >= 24 && input[0] == 0xAA && input[1] == 0x08, "firmware has its key and an end");
    require(problem_in_firmware(input.first(input.size() - 1)).has_value(), "cut firmware is refused");
    BootStream stream;
    for (std::size_t i = 0; i < input.size(); ++i) {
        require(stream.state() == BootStream::State::Open, "it does not end before its end");
        stream.push(input[i]);
    }
    require(stream.state() == BootStream::State::Complete, "it ends with its last byte");
}

void fuzz_packets(std::span<const std::uint8_t> bytes) {
    Input input(bytes);
    Whimsical transport(input);
    Exchange exchange(transport);
    Instant now{0};
    while (!input.empty()) {
        now += std::chrono::microseconds(250 * (1 + input.byte() % 80));
        transport.poll(now);
        const int misses = exchange.misses();
        const auto reply = exchange.poll(now);
        require(exchange.misses() <= misses + 1, "one command is missed at most once");
        if (reply)
            for (const int count : reply->encoders)
                require(std::abs(count) <= 32768, "counts are of 16 bits");
        if (exchange.free()) exchange.send({}, now);
    }
    // Left alone, it asks again: what is under way ends or is given up.
    for (int ms = 0; ms < 200; ++ms) exchange.poll(now += std::chrono::milliseconds(1));
    require(exchange.free() || transport.out() == Transfer::Pending, "it does not wait for ever");
}

void fuzz_flight(std::span<const std::uint8_t> input) {
    std::string text(input.begin(), input.end());
    // Chance finds neither this version, nor 14000 bytes of a state, nor a sum.
    constexpr std::string_view kVersion = "\nversion ";
    if (const std::size_t at = text.find(kVersion); at != std::string::npos) {
        const std::size_t begin = at + kVersion.size();
        text.replace(begin, std::min(text.find('\n', begin), text.size()) - begin, EDDY_VERSION);
    }
    constexpr std::string_view kState = "\nstate!\n";
    if (const std::size_t at = text.find(kState); at != std::string::npos) {
        static const std::string state = [] {
            const std::string none = flight_text(Flight{});
            const std::size_t begin = none.find("\nstate ");
            return none.substr(begin, none.find('\n', begin + 1) + 1 - begin);
        }();
        text.replace(at, kState.size(), state);
    }
    if (const std::size_t end = text.rfind("\nend "); end != std::string::npos) {
        const std::size_t ticks = text.find(' ', end + 5);
        if (ticks != std::string::npos)
            text = text.substr(0, ticks) +
                   fmt::format(" {:016x}\n", flight_sum(std::string_view(text).substr(0, end + 1)));
    }
    try {
        const Flight flight = read_flight(text, "f");
        for (const LawOutput& out : rerun(flight).outputs)
            require(!to_word(out.reason).empty(), "a reason has a word");
        const std::string again = flight_text(flight);
        require(flight_text(read_flight(again, "f")) == again, "a flight writes back as it was read");
    } catch (const InputError& e) {
        const std::string what = e.what();
        require(what.starts_with("f:") && what.size() < 400, "a refusal names the file and is short");
        require(what.find('\n') == std::string::npos, "a refusal is one line");
    }
}

}  // namespace eddy
