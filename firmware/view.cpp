#include "firmware/view.h"

#include "firmware/cost_page.h"
#include "firmware/exhibit/caption.h"
#include "firmware/render_setup.h"

namespace eddy {
namespace {

using namespace std::chrono_literals;

/// How long what is written over the picture stays the same: as long as it takes to read a number.
constexpr Instant kPageStays = 1s;

}  // namespace

View::View(gles::Gpu& gpu, const gles::FluidSetup& fluid, const Scene& scene, bool shows_cost)
    : gpu_(gpu), renderer_(gpu, fluid, render_setup(scene)), caption_(gpu, renderer_.picture()) {
    show_cost(shows_cost);
}

void View::show_cost(bool shown) {
    if (shown && !overlay_) overlay_.emplace(gpu_, renderer_.picture());
    if (!shown) overlay_.reset();
    page_due_ = Instant(0);
}

void View::draw(const gles::Fluid& fluid, const std::vector<gles::BodyState>& bodies, Instant now,
                const std::function<CostFigures()>& figures, const std::string& caption) {
    renderer_.draw(fluid, bodies);
    if (caption != sentence_) caption_page_ = caption_page(caption, renderer_.picture().size());
    sentence_ = caption;
    caption_.draw(caption_page_);
    if (!overlay_) return;
    if (now >= page_due_) {
        page_ = cost_page(figures(), renderer_.picture().size());
        page_due_ = now + kPageStays;
    }
    overlay_->draw(page_);
}

}  // namespace eddy
