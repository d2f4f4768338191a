#pragma once
#include "firmware/cost_figures.h"
#include "gles/render/page.h"

namespace eddy {

/// "What does accuracy cost": the figures as words and bars, for the upper left corner of a picture of this size. Words
/// grow with the picture: from two metres they are read on a screen of 24 inches or more.
gles::Page cost_page(const CostFigures& figures, const glm::ivec2& picture_px);

}  // namespace eddy
