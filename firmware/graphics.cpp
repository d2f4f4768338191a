#include "firmware/graphics.h"

#include <fmt/format.h>

#include <string_view>

#include "firmware/text_file.h"
#include "hal/display/kms/kms_display.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

}  // namespace

bool Graphics::in_software() const {
    if (!display->native_display()) return true;
    // A card that only shows (virtio-gpu, an old one) has its pictures drawn by the processor.
    const std::string& renderer = context.capabilities().renderer;
    for (const std::string_view name : {"llvmpipe", "softpipe", "swrast"})
        if (renderer.find(name) != renderer.npos) return true;
    return false;
}

std::filesystem::path screen_memory(const std::filesystem::path& state_dir) {
    return state_dir / "screen";
}

std::string last_screen(const std::filesystem::path& state_dir) {
    try {
        const std::string text = read_text_file(screen_memory(state_dir));
        return text.substr(0, text.find('\n'));
    } catch (const std::runtime_error&) {
        return "";  // there was none
    }
}

std::unique_ptr<Graphics> open_headless() {
    std::unique_ptr<Display> display = make_headless_display();
    const bool on_gpu = display->native_display() != nullptr;
    try {
        return std::make_unique<Graphics>(std::move(display));
    } catch (const gles::GlError& e) {
        if (!on_gpu) throw;
        fmt::print(stderr, "the GPU cannot be used ({}); drawing in software instead\n", e.what());
        return std::make_unique<Graphics>(make_software_display());
    }
}

std::unique_ptr<Graphics> open_screen(const ScreenConfig& config, const std::filesystem::path& state_dir) {
    return std::make_unique<Graphics>(std::make_unique<kms::KmsDisplay>(
        kms::make_machine(), kms::Wish{config.connector, config.mode, last_screen(state_dir)}));
}

std::unique_ptr<Graphics> open_display(DisplayChoice choice, const ScreenConfig& config,
                                       const std::filesystem::path& state_dir) {
    if (choice == DisplayChoice::Headless) return open_headless();
    if (choice == DisplayChoice::Kms) return open_screen(config, state_dir);
    const bool had_card = card_has_come();
    bool lacks_card = false;
    try {
        return open_screen(config, state_dir);
    } catch (const kms::KmsError& e) {
        fmt::print(stderr, "no screen is used ({}); going on without\n", e.what());
        // One that came, or went, in between has not refused: it is looked for again.
        lacks_card = !had_card || !card_has_come();
    } catch (const gles::GlError& e) {
        fmt::print(stderr, "the screen cannot be drawn on ({}); going on without\n", e.what());
    }
    std::unique_ptr<Graphics> graphics = open_headless();
    graphics->lacks_card = lacks_card;
    return graphics;
}

bool card_has_come() {
    return kms::has_card(*kms::make_machine());
}

std::unique_ptr<Graphics> open_again(std::unique_ptr<Graphics> lost, Seconds patience) {
    // A context that is made too early is lost as well (KHR_robustness).
    RealClock clock;
    while (lost->context.reset_status() != gles::ResetStatus::None) {
        if (Seconds(clock.now()) > patience)
            throw gles::GlError("the GPU was reset, and its driver does not get over it");
        clock.sleep_until(clock.now() + 10ms);
    }
    std::unique_ptr<Display> display = std::move(lost->display);
    const bool lacks_card = lost->lacks_card;
    lost.reset();
    auto graphics = std::make_unique<Graphics>(std::move(display));
    graphics->lacks_card = lacks_card;
    return graphics;
}

}  // namespace eddy
