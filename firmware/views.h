#pragma once
#include <map>

#include "firmware/view.h"

namespace eddy {

/// A picture for each grid that a show may change to.
class Views {
  public:
    /// As for View.
    Views(gles::Gpu& gpu, const Scene& scene, bool shows_cost)
        : gpu_(gpu), scene_(scene), shows_cost_(shows_cost) {}

    /// Whether the page "What does accuracy cost?" lies over the picture, from now on.
    void show_cost(bool shown);

    /// That of this fluid's grid; made if it is the first.
    View& of(const gles::Fluid& fluid);
    /// Draws this fluid unless its grid has been drawn before: the driver compiles now what it would during the show.
    void make_ready(const gles::Fluid& fluid, const std::vector<gles::BodyState>& bodies, Instant now,
                    const std::function<CostFigures()>& figures);

  private:
    gles::Gpu& gpu_;
    Scene scene_;
    bool shows_cost_;
    std::map<int, View> views_;  ///< by cells along x: a tank has only one grid with so many
};

}  // namespace eddy
