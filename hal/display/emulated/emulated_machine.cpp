#include "hal/display/emulated/emulated_machine.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <drm_fourcc.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace eddy::emulated {
namespace {

/// Buffers that nobody draws into. It has no native window: whoever draws takes a window nobody sees.
class EmulatedWindow final : public kms::Window {
  public:
    EmulatedWindow(const kms::Buffer& like, int count)
        : buffers_(static_cast<std::size_t>(count), like), locked_(static_cast<std::size_t>(count)) {}
    void* native() const override { return nullptr; }
    const kms::Buffer* lock_front() override {
        const auto free = std::find(locked_.begin(), locked_.end(), false);
        if (free == locked_.end()) return nullptr;
        *free = true;
        return &buffers_[static_cast<std::size_t>(free - locked_.begin())];
    }
    void release(const kms::Buffer* buffer) override {
        locked_.at(static_cast<std::size_t>(buffer - buffers_.data())) = false;
    }
    bool has_free() const override {
        return std::find(locked_.begin(), locked_.end(), false) != locked_.end();
    }

  private:
    std::vector<kms::Buffer> buffers_;
    std::vector<bool> locked_;
};

class EmulatedWindows final : public kms::WindowMaker {
  public:
    explicit EmulatedWindows(std::shared_ptr<GraphicsCard> card) : card_(std::move(card)) {}
    void* native() const override { return nullptr; }
    unsigned egl_platform() const override { return EGL_PLATFORM_SURFACELESS_MESA; }
    std::unique_ptr<kms::Window> make(std::uint32_t width, std::uint32_t height, std::uint32_t format,
                                      kms::Layout layout, std::span<const std::uint64_t> modifiers) override {
        if (card_->no_layouts.contains(layout) || card_->no_formats.contains(format)) return nullptr;
        kms::Buffer buffer;
        buffer.width = width;
        buffer.height = height;
        buffer.format = format;
        buffer.modifier = layout == kms::Layout::Modifiers ? modifiers.front() : DRM_FORMAT_MOD_INVALID;
        return std::make_unique<EmulatedWindow>(buffer, card_->buffers);
    }

  private:
    std::shared_ptr<GraphicsCard> card_;
};

class EmulatedMachine final : public kms::Machine {
  public:
    explicit EmulatedMachine(std::shared_ptr<ScreenMachine::World> world) : world_(std::move(world)) {}

    std::vector<std::string> cards() override {
        std::vector<std::string> paths;
        for (const auto& card : world_->cards) paths.push_back(card->path);
        return paths;
    }
    Opened open(const std::string& path) override {
        const std::shared_ptr<GraphicsCard> card = find(path);
        if (!card) return {nullptr, ENOENT};
        if (card->open_error != 0) return {nullptr, card->open_error};
        return {card->open(card, world_->next_fd++), 0};
    }
    std::unique_ptr<kms::WindowMaker> make_windows(kms::Card& card) override {
        const std::shared_ptr<GraphicsCard> found = find(card.path());
        if (!found->makes_windows) return nullptr;
        return std::make_unique<EmulatedWindows>(found);
    }
    bool plugs_changed() override { return std::exchange(world_->plugs_changed, false); }
    std::string holders(const std::string& path) override { return find(path)->other_master; }
    void set_console_text(bool on) override { world_->console_text = on; }

  private:
    std::shared_ptr<GraphicsCard> find(const std::string& path) const {
        for (const auto& card : world_->cards)
            if (card->path == path) return card;
        return nullptr;
    }
    std::shared_ptr<ScreenMachine::World> world_;
};

}  // namespace

ScreenMachine::ScreenMachine() : world_(std::make_shared<World>()) {
    add_card();
}

std::unique_ptr<kms::Machine> ScreenMachine::machine() const {
    return std::make_unique<EmulatedMachine>(world_);
}

GraphicsCard& ScreenMachine::add_card() {
    world_->cards.push_back(
        std::make_shared<GraphicsCard>(fmt::format("/dev/dri/card{}", world_->cards.size())));
    world_->cards.back()->now = world_->now;
    return *world_->cards.back();
}

void ScreenMachine::wait(Instant time) const {
    world_->now += time;
    for (const auto& card : world_->cards) card->now += time;
}

}  // namespace eddy::emulated
