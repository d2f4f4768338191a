#include "firmware/stability/transport_watch.h"

#include <algorithm>

#include "gles/grid_io.h"

namespace eddy::stability {

TransportWatch::TransportWatch(gles::Gpu& gpu) : gpu_(gpu) {
    gpu_.record(&passes_);
    gpu_.watch_stages([this](std::string_view stage, bool begins) { see(stage, begins); });
}

TransportWatch::~TransportWatch() {
    gpu_.watch_stages({});
    gpu_.record(nullptr);
}

void TransportWatch::begin_step(const gles::Fluid& fluid) {
    cells_ = fluid.setup().cells;
    passes_.clear();
    watching_ = true;
    before_ = after_ = {};
    for (const glm::vec3& u : fluid.velocity()) before_.add(u);
    for (const gles::SourceSetup& source : fluid.setup().sources)
        if (source.velocity_m_s) before_.add(glm::vec3(*source.velocity_m_s));
}

void TransportWatch::see(std::string_view stage, bool begins) {
    if (!watching_ || begins || stage != "advect velocity" || passes_.empty()) return;
    watching_ = false;
    // What the last pass of the stage wrote; the texture is used again later in the step.
    const gles::AtlasLayout layout = gles::Faces::layout(cells_);
    for (const glm::vec3& u : gles::unpack_vectors(passes_.back().outputs.at(0)->download(), layout))
        after_.add(u);
}

double TransportWatch::overshoot_m_s() const {
    const glm::vec3 beyond = glm::max(after_.high - before_.high, before_.low - after_.low);
    return std::max({0.0f, beyond.x, beyond.y, beyond.z});
}

}  // namespace eddy::stability
