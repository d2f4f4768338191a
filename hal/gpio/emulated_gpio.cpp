#include "hal/gpio/emulated_gpio.h"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <system_error>
#include <utility>

#include "hal/gpio/find_line.h"

namespace eddy {
namespace {

constexpr std::string_view kPath = "/dev/gpiochip";

[[noreturn]] void fail(int error) {
    throw std::system_error(error, std::generic_category(), "emulated");
}

std::size_t chip_at(const std::string& path) {
    std::size_t number = 0;
    std::from_chars(path.data() + kPath.size(), path.data() + path.size(), number);
    return number;
}

}  // namespace

class EmulatedGpio::Requested final : public GpioLine {
  public:
    Requested(std::shared_ptr<Shared> shared, Spot spot, const GpioWish& wish)
        : shared_(std::move(shared)), spot_(spot), wish_(wish) {
        if (!wish.output && shared_->chips[spot.chip].edges) edges_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
        line().info.used = true;
        line().info.output = wish.output;
        line().info.consumer = "eddy";
        if (wish.output) line().high = wish.active_low;
        shared_->requested.push_back(this);
    }
    ~Requested() override {
        const std::lock_guard lock(shared_->mutex);
        std::erase(shared_->requested, this);
        if (!gone_) line().info = {.name = line().info.name, .consumer = {}};
        if (edges_ >= 0) close(edges_);
    }
    Requested(const Requested&) = delete;
    Requested& operator=(const Requested&) = delete;

    bool active() override {
        const std::lock_guard lock(shared_->mutex);
        if (gone_) fail(ENODEV);
        bool high = line().high;
        if (!line().chatter.empty()) {
            high = line().chatter.back();
            line().chatter.pop_back();
        }
        return high != wish_.active_low;
    }
    void set(bool active) override {
        const std::lock_guard lock(shared_->mutex);
        if (gone_) fail(ENODEV);
        if (!wish_.output) fail(EPERM);
        line().high = active != wish_.active_low;
    }
    int edges_fd() const override { return edges_; }
    bool take_edges() override {
        const std::lock_guard lock(shared_->mutex);
        std::uint64_t count = 0;
        if (edges_ >= 0 && ::read(edges_, &count, sizeof count) < 0 && errno != EAGAIN) fail(errno);
        return std::exchange(rose_, false);
    }

    // With the lock held.
    const Spot& spot() const { return spot_; }
    void tell_edge() {
        const std::uint64_t one = 1;
        rose_ |= !gone_ && edges_ >= 0 && line().high != wish_.active_low;
        if (edges_ >= 0 && ::write(edges_, &one, sizeof one) < 0 && errno != EAGAIN) fail(errno);
    }
    void lose() {
        gone_ = true;
        tell_edge();
    }

  private:
    Line& line() { return shared_->chips[spot_.chip].lines[spot_.line]; }

    std::shared_ptr<Shared> shared_;
    Spot spot_;
    GpioWish wish_;
    int edges_ = -1;
    bool gone_ = false, rose_ = false;
};

void EmulatedGpio::add(const std::string& label, const std::vector<std::string>& line_names, bool edges) {
    const std::lock_guard lock(shared_->mutex);
    Chip chip{.label = label, .edges = edges};
    for (const std::string& name : line_names)
        chip.lines.push_back({.info = {.name = name, .consumer = {}}, .chatter = {}});
    shared_->chips.push_back(std::move(chip));
}

EmulatedGpio::Spot EmulatedGpio::spot_of(const std::string& address) const {
    std::vector<GpioChip> all;
    for (const Chip& chip : shared_->chips) {
        all.push_back({fmt::format("{}{}", kPath, all.size()), "", chip.label, ""});
        for (const Line& line : chip.lines) all.back().lines.push_back(line.info);
    }
    const GpioPlace place = find_line(all, address);
    return {chip_at(place.chip_path), place.offset};
}

void EmulatedGpio::set_high(const std::string& address, bool high) {
    const std::lock_guard lock(shared_->mutex);
    const Spot spot = spot_of(address);
    if (std::exchange(shared_->chips[spot.chip].lines[spot.line].high, high) == high) return;
    for (Requested* each : shared_->requested)
        if (each->spot() == spot) each->tell_edge();
}

bool EmulatedGpio::is_high(const std::string& address) const {
    const std::lock_guard lock(shared_->mutex);
    const Spot spot = spot_of(address);
    return shared_->chips[spot.chip].lines[spot.line].high;
}

void EmulatedGpio::bounce(const std::string& address, std::vector<bool> high) {
    const std::lock_guard lock(shared_->mutex);
    const Spot spot = spot_of(address);
    std::reverse(high.begin(), high.end());
    shared_->chips[spot.chip].lines[spot.line].chatter = std::move(high);
}

void EmulatedGpio::use_elsewhere(const std::string& address, const std::string& consumer) {
    const std::lock_guard lock(shared_->mutex);
    const Spot spot = spot_of(address);
    GpioLineInfo& info = shared_->chips[spot.chip].lines[spot.line].info;
    info.used = true;
    info.consumer = consumer;
}

void EmulatedGpio::refuse(const std::string& address, int error) {
    const std::lock_guard lock(shared_->mutex);
    const Spot spot = spot_of(address);
    shared_->chips[spot.chip].lines[spot.line].refusal = error;
}

void EmulatedGpio::plug(const std::string& label, bool in) {
    const std::lock_guard lock(shared_->mutex);
    for (std::size_t i = 0; i < shared_->chips.size(); ++i) {
        Chip& chip = shared_->chips[i];
        if (chip.label != label || chip.plugged_in == in) continue;
        chip.plugged_in = in;
        if (in) continue;
        for (Requested* each : shared_->requested)
            if (each->spot().chip == i) each->lose();
        for (Line& line : chip.lines) line.info = {.name = line.info.name, .consumer = {}};
    }
}

void EmulatedGpio::deny(const std::string& label, const std::string& trouble) {
    const std::lock_guard lock(shared_->mutex);
    for (Chip& chip : shared_->chips)
        if (chip.label == label) chip.trouble = trouble;
}

std::vector<GpioChip> EmulatedGpio::chips() {
    const std::lock_guard lock(shared_->mutex);
    std::vector<GpioChip> all;
    for (std::size_t i = 0; i < shared_->chips.size(); ++i) {
        const Chip& chip = shared_->chips[i];
        if (!chip.plugged_in) continue;
        GpioChip seen{fmt::format("{}{}", kPath, i), fmt::format("gpiochip{}", i), "", chip.trouble};
        if (chip.trouble.empty()) {
            seen.label = chip.label;
            for (const Line& line : chip.lines) seen.lines.push_back(line.info);
        }
        all.push_back(std::move(seen));
    }
    return all;
}

std::unique_ptr<GpioLine> EmulatedGpio::request(const std::string& chip_path, unsigned offset,
                                                const GpioWish& wish) {
    const std::lock_guard lock(shared_->mutex);
    const Spot spot{chip_at(chip_path), offset};
    if (spot.chip >= shared_->chips.size() || !shared_->chips[spot.chip].plugged_in) fail(ENODEV);
    const Chip& chip = shared_->chips[spot.chip];
    if (!chip.trouble.empty()) fail(EACCES);
    if (offset >= chip.lines.size()) fail(EINVAL);
    if (chip.lines[offset].refusal != 0) fail(chip.lines[offset].refusal);
    if (chip.lines[offset].info.used) fail(EBUSY);
    return std::make_unique<Requested>(shared_, spot, wish);
}

}  // namespace eddy
