#include "gles/fluid/driven.h"

#include <algorithm>
#include <limits>

#include "gles/body/bounds.h"
#include "gles/fluid/transport.h"

namespace eddy::gles {
namespace {

/// Crossings of the tank after which the speed of what has stopped counts half.
constexpr double kCrossings = 4.0;

bool is_unknown(const FluidSetup& setup) {
    const bool weight = (setup.smoke && setup.smoke->weight != 0.0) ||
                        (setup.temperature && setup.temperature->expansion_1_k != 0.0);
    const bool free = std::any_of(setup.bodies.begin(), setup.bodies.end(),
                                  [](const BodySetup& body) { return body.coupled.has_value(); });
    const bool falls = setup.gravity_m_s2 != glm::dvec3(0.0) && (weight || free);
    const WallSetup still;
    const bool walls = std::any_of(setup.walls.begin(), setup.walls.end(), [&](const WallSetup& wall) {
        return wall.kind != WallKind::Open && wall.velocity_m_s.glsl != still.velocity_m_s.glsl;
    });
    return falls || walls || setup.acceleration_m_s2.has_value();
}

}  // namespace

Driven::Driven(const FluidSetup& setup) : setup_(&setup), unknown_(is_unknown(setup)) {}

void Driven::go_on(const std::vector<BodyState>& bodies, double time_s, double dt_s) {
    const glm::dvec3 size_m = setup_->cell_m * glm::dvec3(setup_->cells);
    const double longest_m = std::max({size_m.x, size_m.y, size_m.z});
    speed_m_s_ /= 1.0 + speed_m_s_ * dt_s / (kCrossings * longest_m);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        speed_m_s_ = std::max(
            speed_m_s_, glm::length(bodies[i].velocity_m_s) +
                            glm::length(bodies[i].spin_rad_s) * bounding_radius_m(setup_->bodies[i].shape));
    for (const SourceSetup& source : setup_->sources)
        if (source.velocity_m_s && is_running(source, time_s))
            speed_m_s_ = std::max(speed_m_s_, glm::length(*source.velocity_m_s));
}

double Driven::speed_m_s() const {
    return unknown_ ? std::numeric_limits<float>::max() : speed_m_s_;
}

}  // namespace eddy::gles
