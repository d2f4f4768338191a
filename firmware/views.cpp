#include "firmware/views.h"

namespace eddy {

View& Views::of(const gles::Fluid& fluid) {
    const gles::FluidSetup& setup = fluid.setup();
    return views_.try_emplace(setup.cells.x, gpu_, setup, scene_, shows_cost_).first->second;
}

void Views::show_cost(bool shown) {
    shows_cost_ = shown;
    for (auto& [cells, view] : views_) view.show_cost(shown);
}

void Views::make_ready(const gles::Fluid& fluid, const std::vector<gles::BodyState>& bodies, Instant now,
                       const std::function<CostFigures()>& figures) {
    if (!views_.contains(fluid.setup().cells.x)) of(fluid).draw(fluid, bodies, now, figures);
}

}  // namespace eddy
