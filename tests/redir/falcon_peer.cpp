#include "tests/redir/falcon_peer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/redir/command_line.h"

namespace eddy::redir {
namespace {

using namespace std::chrono_literals;
using emulated::BoardState;

constexpr Instant kHomeAgain = 5s;

const char* name_of(BoardState state) {
    switch (state) {
        case BoardState::Cold:
            return "cold";
        case BoardState::Pic:
            return "pic";
        case BoardState::FindingRate:
            return "finding-rate";
        case BoardState::Loading:
            return "loading";
        case BoardState::RunUnhomed:
            return "unhomed";
        case BoardState::RunHomed:
            return "homed";
    }
    return "?";
}

double rounded(double number) {
    return std::round(number * 1e5) / 1e5 + 0.0;  // and no -0
}

nlohmann::ordered_json list_of(const glm::dvec3& v) {
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

emulated::PlantSettings plant_with(emulated::Hand hand) {
    emulated::PlantSettings plant;
    plant.hand = hand;
    return plant;
}

std::unique_ptr<emulated::EmulatedFalcon> falcon_with(std::unique_ptr<SteeredMotion> motion,
                                                      const FalconPeerSettings& settings) {
    emulated::BoardSettings board;
    board.start = settings.start;
    return std::make_unique<emulated::EmulatedFalcon>(std::move(motion), plant_with(settings.hand), board);
}

}  // namespace

FalconPeer::FalconPeer(std::unique_ptr<emulated::HandMotion> path, const FalconPeerSettings& settings)
    : settings_(settings),
      motion_(nullptr),
      device_(falcon_with(
                  [&] {
                      auto motion = std::make_unique<SteeredMotion>(std::move(path));
                      motion_ = motion.get();
                      return motion;
                  }(),
                  settings),
              {.serial = settings.serial}) {
    device_.unplug();
}

void FalconPeer::poll(Instant now) {
    for (std::size_t i = 0; i < released_at_.size(); ++i)
        if (released_at_[i] && now >= *released_at_[i]) {
            board().buttons &= static_cast<std::uint8_t>(~(1U << i));
            released_at_[i].reset();
        }
    if (speaks_at_ && now >= *speaks_at_) {
        device_.falcon().line_dead = false;
        speaks_at_.reset();
    }
    if (wakes_at_ && now >= *wakes_at_) {
        device_.hung = false;
        wakes_at_.reset();
    }
    home_if_asked(now);
    device_.poll(now);
    peak_n_ = std::max(peak_n_, glm::length(force_n()));
}

void FalconPeer::home_if_asked(Instant now) {
    const bool asked = board().state() == BoardState::RunUnhomed && board().last_command().homing;
    if (!asked || !settings_.homes || !held_ || now < home_again_at_ || motion_->homing(now)) return;
    motion_->home(now);
    home_again_at_ = now + kHomeAgain;
}

void FalconPeer::reset() {
    device_.unplug();
    device_.plug_in(true);
}

glm::dvec3 FalconPeer::force_n() {
    if (board().state() != BoardState::RunHomed) return glm::dvec3(0.0);
    return falcon::force_of(board().plant().legs(), board().last_command().motors, falcon::kMotorUnitsPerNm);
}

std::string FalconPeer::command(Instant now, std::string_view line) {
    const auto words = words_of(line);
    if (words.empty()) return "nothing said";
    const std::string& verb = words[0];
    const auto take_hold = [this] {
        held_ = true;
        board().plant().hold(settings_.hand);
    };
    if (verb == "hold" && words.size() == 4) {
        const auto x = number_in(words[1]), y = number_in(words[2]), z = number_in(words[3]);
        if (!x || !y || !z || std::max({std::abs(*x), std::abs(*y), std::abs(*z)}) > 0.2)
            return "hold X Y Z: three numbers within 0.2 m";
        take_hold();
        motion_->hold(now, {*x, *y, *z});
    } else if (verb == "follow" && words.size() == 1) {
        take_hold();
        motion_->follow(now);
    } else if (verb == "home" && words.size() == 1) {
        take_hold();
        motion_->home(now);
    } else if (verb == "let-go" && words.size() == 1) {
        held_ = false;
        board().plant().let_go();
    } else if (verb == "power-loss" && words.size() == 1) {
        board().lose_power();
    } else if ((verb == "press" || verb == "release") && (words.size() == 2 || words.size() == 3)) {
        const auto button = index_in(words[1], 3);
        const auto time = words.size() == 3 ? time_in(words[2]) : std::optional(Instant(0));
        if (!button || !time) return verb + " N [MS]: a button from 0 to 3, and a time";
        const auto bit = static_cast<std::uint8_t>(1U << *button);
        released_at_[*button].reset();
        if (verb == "release") {
            board().buttons &= static_cast<std::uint8_t>(~bit);
        } else {
            board().buttons |= bit;
            if (words.size() == 3) released_at_[*button] = now + *time;
        }
    } else if ((verb == "silent" || verb == "hang") && words.size() == 2) {
        const auto time = time_in(words[1]);
        if (!time) return verb + " TIME: such as 2s or 300ms";
        (verb == "silent" ? speaks_at_ : wakes_at_) = now + *time;
        (verb == "silent" ? device_.falcon().line_dead : device_.hung) = true;
    } else {
        return "not understood; hold X Y Z, follow, let-go, home, press N [MS], release N, silent TIME, hang "
               "TIME, "
               "power-loss, unplug, plug, cut, quit";
    }
    return {};
}

FalconPeer::Seen FalconPeer::look() {
    const falcon::Command& command = board().last_command();
    return {board().state(), command.red, command.green, command.blue, board().buttons};
}

void FalconPeer::report(Instant now, EventLog& log) {
    const Seen seen = look();
    if (reported_ != seen) {
        reported_ = seen;
        log.write(now, "state",
                  {{"state", name_of(seen.state)},
                   {"red", seen.red},
                   {"green", seen.green},
                   {"blue", seen.blue},
                   {"buttons", seen.buttons}});
    }
    if (now - second_began_ < 1s) return;
    const Seconds passed = now - second_began_;
    const std::uint64_t frames = board().frames();
    log.write(now, "second",
              {{"state", name_of(seen.state)},
               {"exchanges_per_s", rounded(static_cast<double>(frames - frames_before_) / passed.count())},
               {"motors", board().last_command().motors},
               {"force_n", list_of(force_n())},
               {"peak_force_n", rounded(peak_n_)},
               {"largest_motor", board().largest_motor()},
               {"position_m", list_of(board().plant().position_m())},
               {"held", held_},
               {"red", seen.red},
               {"green", seen.green},
               {"blue", seen.blue}});
    second_began_ = now;
    frames_before_ = frames;
    peak_n_ = 0.0;
}

}  // namespace eddy::redir
