#pragma once
#include <optional>
#include <string>

#include "firmware/cost_figures.h"
#include "gles/render/renderer.h"
#include "gles/render/text.h"

namespace eddy {

/// The picture of a fluid, and what is written over it.
class View {
  public:
    /// `shows_cost`: the page "What does accuracy cost?" lies over it.
    View(gles::Gpu& gpu, const gles::FluidSetup& fluid, const Scene& scene, bool shows_cost);

    void show_cost(bool shown);
    /// `figures` are asked for when the page is due; `caption`, if any, stands under the picture.
    void draw(const gles::Fluid& fluid, const std::vector<gles::BodyState>& bodies, Instant now,
              const std::function<CostFigures()>& figures, const std::string& caption = {});
    const gles::Renderer& renderer() const { return renderer_; }

  private:
    gles::Gpu& gpu_;
    gles::Renderer renderer_;
    std::optional<gles::Text> overlay_;
    gles::Text caption_;
    std::string sentence_;
    gles::Page page_, caption_page_;
    Instant page_due_{0};
};

}  // namespace eddy
