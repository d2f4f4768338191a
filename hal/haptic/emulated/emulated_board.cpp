#include "hal/haptic/emulated/emulated_board.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace eddy::emulated {
namespace {

using falcon::Axes;
using falcon::Command;

constexpr std::array<std::uint8_t, 3> kQuestion{0x0A, 0x43, 0x0D};
constexpr std::array<std::uint8_t, 4> kAnswer{0x0A, 0x44, 0x2C, 0x0D};
constexpr std::uint8_t kRateLetter = 0x41;

// An arm swung in beyond this count passes its index mark. A guess: the marks are somewhere near the inward
// stop.
constexpr double kIndexCount = -1100.0;

bool near_rate(double rate, double nominal) {
    return std::abs(rate / nominal - 1.0) < 0.03;
}
bool pic_rate(double rate) {
    return near_rate(rate, 9600.0);
}
bool run_rate(double rate) {
    return near_rate(rate, 1.5e6);
}
bool load_rate(double rate) {
    return near_rate(rate, 141e3);
}  // what its drivers use: 139 to 143 kBd

bool take_one(int& count) {
    if (count == 0) return false;
    --count;
    return true;
}

}  // namespace

EmulatedBoard::EmulatedBoard(std::unique_ptr<HandMotion> motion, const PlantSettings& plant,
                             const BoardSettings& settings)
    : settings_(settings), plant_(std::move(motion), plant), state_(settings.start) {
    homed_.fill(state_ == BoardState::RunHomed);
}

void EmulatedBoard::advance(Instant now) {
    const Instant bites_at = commanded_at_ + settings_.watchdog;
    if (!watchdog_bit_ && now >= bites_at) {
        plant_.advance(bites_at, motor_force());
        watchdog_bit_ = true;
        command_ = {};
    }
    plant_.advance(now, motor_force());
}

glm::dvec3 EmulatedBoard::motor_force() const {
    if (state_ != BoardState::RunHomed || watchdog_bit_ || faults.no_supply) return glm::dvec3(0.0);
    return falcon::force_of(plant_.legs(), command_.motors, settings_.motor_units_per_nm);
}

EmulatedBoard::Answer EmulatedBoard::receive(Instant now, std::uint8_t byte, double rate) {
    Answer answer;
    answer.at = now;
    switch (state_) {
        case BoardState::Cold:
            break;
        case BoardState::Pic:
            if (pic_rate(rate)) pic_byte(byte, answer);
            break;
        case BoardState::FindingRate:
            if (load_rate(rate) && byte == kRateLetter) {
                if (settings_.two_byte_echo) answer.add(0x13);
                answer.add(kRateLetter);
                stream_ = {};
                loaded_ = 0;
                state_ = BoardState::Loading;
            }
            break;
        case BoardState::Loading:
            if (load_rate(rate)) load_byte(byte, answer);
            break;
        case BoardState::RunUnhomed:
        case BoardState::RunHomed:
            if (run_rate(rate)) run_byte(now, byte, answer);
            break;
    }
    return answer;
}

void EmulatedBoard::set_dtr(bool high, double rate) {
    const bool rises = high && !dtr_;
    const bool falls = !high && dtr_;
    dtr_ = high;
    if (rises && pic_rate(rate)) {
        state_ = BoardState::Pic;
        matched_ = 0;
        homed_.fill(false);
        command_ = {};
    } else if (falls && state_ == BoardState::Pic) {
        state_ = BoardState::FindingRate;
    } else if ((rises || falls) && state_ == BoardState::Loading) {
        state_ = BoardState::Cold;
    }
}

void EmulatedBoard::lose_power() {
    state_ = BoardState::Cold;
    homed_.fill(false);
    command_ = {};
    watchdog_bit_ = true;
    finder_.clear();
}

void EmulatedBoard::pic_byte(std::uint8_t byte, Answer& answer) {
    matched_ = byte == kQuestion[matched_] ? matched_ + 1 : (byte == kQuestion[0] ? 1 : 0);
    if (matched_ < kQuestion.size()) return;
    matched_ = 0;
    if (take_one(faults.deaf_calls)) return;
    if (settings_.leading_zero) answer.add(0x00);
    for (const std::uint8_t letter : kAnswer) answer.add(letter);
    answer.at += faults.slow_answer;
}

void EmulatedBoard::load_byte(std::uint8_t byte, Answer& answer) {
    const bool wrong = loaded_++ == faults.wrong_echo_at;
    if (wrong) faults.wrong_echo_at = -1;
    answer.add(wrong ? static_cast<std::uint8_t>(~byte) : byte);
    switch (stream_.push(byte)) {
        case falcon::BootStream::State::Open:
            break;
        case falcon::BootStream::State::WrongKey:
            state_ = BoardState::Cold;
            break;
        case falcon::BootStream::State::Complete:
            state_ = BoardState::RunUnhomed;
            break;
    }
}

void EmulatedBoard::run_byte(Instant now, std::uint8_t byte, Answer& answer) {
    const auto frame = finder_.push(byte);
    if (!frame) return;
    advance(now);
    obey(now, falcon::decode_command(*frame));
    answer.at = now + settings_.turnaround + faults.slow_reply;
    if (!take_one(faults.lost_replies)) reply(answer);
}

void EmulatedBoard::obey(Instant now, const Command& command) {
    ++frames_;
    for (const int motor : command.motors) {
        largest_motor_ = std::max(largest_motor_, std::abs(motor));
        if (state_ != BoardState::RunHomed)
            largest_motor_unhomed_ = std::max(largest_motor_unhomed_, std::abs(motor));
    }
    command_ = command;
    commanded_at_ = now;
    watchdog_bit_ = false;

    if (std::exchange(faults.homing_lost, false)) {
        homed_.fill(false);
        state_ = BoardState::RunUnhomed;
    } else if (command.homing && !faults.no_supply) {
        for (std::size_t i = 0; i < homed_.size(); ++i)
            if (falcon::encoder_count(plant_.legs().theta1[i]) < kIndexCount && !(faults.no_index && i == 2))
                homed_[i] = true;
        if (homed_[0] && homed_[1] && homed_[2]) state_ = BoardState::RunHomed;
    }
}

void EmulatedBoard::reply(Answer& answer) {
    const falcon::Frame frame =
        falcon::encode(falcon::Reply{.encoders = encoders(), .homed = homed_, .buttons = buttons});
    if (take_one(faults.garbage))
        for (const std::uint8_t byte : {0x3C, 0x41, 0xFF, 0x00, 0x3E}) answer.add(byte);
    const std::size_t size = take_one(faults.short_replies) ? frame.size() - 2 : frame.size();
    for (std::size_t i = 0; i < size; ++i) answer.add(frame[i]);
    if (take_one(faults.double_replies))
        for (const std::uint8_t byte : frame) answer.add(byte);
}

Axes EmulatedBoard::encoders() const {
    Axes counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) {
        counts[i] = static_cast<int>(std::lround(falcon::encoder_count(plant_.legs().theta1[i])));
        counts[i] += faults.encoder_error[i] + (homed_[i] ? 0 : settings_.unhomed_offset[i]);
    }
    return counts;
}

}  // namespace eddy::emulated
