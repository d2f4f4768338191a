#include "gles/fluid/jets.h"

#include <algorithm>
#include <iterator>

#include "gles/fluid/transport.h"

namespace eddy::gles {

Jets::Jets(Gpu& gpu, const FluidSetup& setup) : cell_m_(setup.cell_m), cells_(setup.cells) {
    std::copy_if(setup.sources.begin(), setup.sources.end(), std::back_inserter(sources_),
                 [](const SourceSetup& source) { return source.velocity_m_s.has_value(); });
    if (!sources_.empty())
        drive_.emplace(gpu, "drive sources", "gles/fluid/drive.frag", Faces::layout(setup.cells), Variant{});
}

Field<Faces> Jets::drive(Field<Faces> u, double time_s) {
    for (const SourceSetup& source : sources_) {
        if (!is_running(source, time_s)) continue;
        const glm::vec4 ball = ball_cells(source, cell_m_);
        drive_->draw({}, {{"ball", ball}, {"ball_velocity", glm::vec3(*source.velocity_m_s)}}, {&u.texture()},
                     Region({ball_box(ball, cells_)}));
    }
    return u;
}

std::vector<Box> Jets::boxes(double time_s) const {
    std::vector<Box> boxes;
    for (const SourceSetup& source : sources_)
        if (is_running(source, time_s)) boxes.push_back(ball_box(ball_cells(source, cell_m_), cells_));
    return boxes;
}

}  // namespace eddy::gles
