#include "firmware/exhibit/front.h"

#include <algorithm>
#include <utility>

namespace eddy {
namespace {

using namespace std::chrono_literals;

/// Between two pictures of wait(): often enough to be seen to move, and no more than a quarter of the time.
constexpr Instant kWaitPause = 50ms;
constexpr int kWaitTimes = 3;

}  // namespace

Front::Front(std::unique_ptr<Graphics> graphics, HandSide& hand, std::filesystem::path screen_memory,
             long most_px)
    : hand_(hand),
      screen_memory_(std::move(screen_memory)),
      most_px_(most_px),
      graphics_(std::move(graphics)) {
    make();
}

void Front::make() {
    screen_ = std::make_unique<Screen>(*graphics_, screen_memory_);
    playbill_ = std::make_unique<Playbill>(graphics_->gpu, hand_);
    notice_ = std::make_unique<Notice>(graphics_->gpu);
}

void Front::announce(const Scene& scene, Act::Setup setup) {
    next_ = {scene, setup};
    Scene shaped = scene;
    if (const auto window = screen_->size_px()) {
        const SizePx size = picture_size(*window, most_px_);
        shaped.render.width_px = size.width;
        shaped.render.height_px = size.height;
    }
    playbill_->announce(shaped, std::move(setup));
}

std::optional<Playbill::News> Front::prepare(const std::function<bool()>& meanwhile) {
    auto news = playbill_->work(meanwhile);
    if (!news) return news;
    if (news->began) playing_ = next_;
    next_.reset();
    // The act that played went with a reset, and what was to follow it cannot be made.
    if (!plays() && playing_) announce(playing_->scene, playing_->setup);
    return news;
}

DisplayState Front::poll(Instant now) {
    const DisplayState state = screen_->poll(now);
    if (screen_->graphics_lost()) recover();
    return state;
}

/// What was drawn with goes before what it was drawn on.
void Front::recover() {
    ++gpu_resets_;
    hand_.orders().give({});  // no force until another fluid has answered
    notice_.reset();
    playbill_.reset();
    screen_.reset();
    graphics_ = open_again(std::move(graphics_));
    make();
    if (const auto again = next_ ? next_ : playing_) announce(again->scene, again->setup);
}

const gles::Texture& Front::show_act(Instant now, const std::string& caption) {
    const gles::Texture& picture = act().draw(now, caption).picture();
    screen_->show(picture);
    return picture;
}

const gles::Texture& Front::show_words(const std::vector<std::string>& lines, Instant now) {
    notice_->draw(lines, now, preparing() && !plays() ? std::optional(playbill_->prepared()) : std::nullopt);
    if (screen_->show(notice_->picture()) || !has_screen()) has_shown_words_ = true;
    return notice_->picture();
}

bool Front::wait(const std::vector<std::string>& lines, Instant now) {
    screen_->poll(now);
    if (screen_->graphics_lost()) return false;
    if (now < wait_due_ || !(wants_picture() || !has_screen())) return true;
    const RealClock clock;
    show_words(lines, now);
    const Instant took = clock.now();
    wait_due_ = now + took + std::max(kWaitPause, kWaitTimes * took);
    return true;
}

}  // namespace eddy
