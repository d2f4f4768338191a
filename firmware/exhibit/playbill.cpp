#include "firmware/exhibit/playbill.h"

#include <exception>

namespace eddy {

void Playbill::announce(const Scene& scene, Act::Setup setup) {
    next_.reset();
    announced_ = {scene, std::move(setup)};
}

/// Whether something is left.
bool Playbill::prepare_a_piece() {
    if (next_) return next_->prepare();
    next_ = std::make_unique<Act>(gpu_, announced_->scene, hand_.exchange(), announced_->setup);
    return true;
}

std::optional<Playbill::News> Playbill::work() {
    if (!announced_) return std::nullopt;
    const RealClock clock;
    News news;
    try {
        const bool more = prepare_a_piece();
        announced_->prepared += clock.now();
        if (more) return std::nullopt;
        next_->begin(hand_.orders(), act_.get());
        act_ = std::move(next_);
        gpu_.free_idle_textures();
        news = {.began = true, .prepared = announced_->prepared};
    } catch (const std::exception& e) {
        next_.reset();
        news = {.prepared = announced_->prepared, .failed = e.what()};
    }
    announced_.reset();
    return news;
}

}  // namespace eddy
