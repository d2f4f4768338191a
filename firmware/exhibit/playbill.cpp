#include "firmware/exhibit/playbill.h"

#include <exception>

namespace eddy {

void Playbill::announce(const Scene& scene, Act::Setup setup) {
    next_.reset();
    announced_ = {scene, std::move(setup)};
}

namespace {

struct GivenUp {};

/// As long as it lives, `meanwhile` is called in the pauses of the GPU's work.
class Pauses {
  public:
    Pauses(gles::Gpu& gpu, const std::function<bool()>& meanwhile) : gpu_(gpu) {
        gpu_.on_pause([&meanwhile](gles::Next) {
            if (!meanwhile()) throw GivenUp();
        });
    }
    ~Pauses() { gpu_.on_pause({}); }
    Pauses(const Pauses&) = delete;
    Pauses& operator=(const Pauses&) = delete;

  private:
    gles::Gpu& gpu_;
};

}  // namespace

double Playbill::prepared() const {
    return next_ ? next_->prepared() : 0.0;
}

/// Whether something is left.
bool Playbill::prepare_a_piece() {
    if (next_) return next_->prepare();
    next_ = std::make_unique<Act>(gpu_, announced_->scene, hand_.exchange(), announced_->setup);
    return true;
}

std::optional<Playbill::News> Playbill::work(const std::function<bool()>& meanwhile) {
    if (!announced_) return std::nullopt;
    const RealClock clock;
    std::optional<Pauses> pauses;
    if (meanwhile) pauses.emplace(gpu_, meanwhile);
    News news;
    try {
        const bool more = prepare_a_piece();
        announced_->prepared += clock.now();
        if (more) return std::nullopt;
        next_->begin(hand_.orders(), act_.get());
        act_ = std::move(next_);
        gpu_.free_idle_textures();
        news = {.began = true, .prepared = announced_->prepared};
    } catch (const GivenUp&) {
        next_.reset();
        return std::nullopt;
    } catch (const std::exception& e) {
        next_.reset();
        news = {.prepared = announced_->prepared, .failed = e.what()};
    }
    announced_.reset();
    return news;
}

}  // namespace eddy
