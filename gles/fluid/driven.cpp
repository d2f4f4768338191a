#include "gles/fluid/driven.h"

#include <algorithm>
#include <limits>

#include "gles/body/bounds.h"
#include "gles/fluid/no_limit.h"
#include "gles/fluid/transport.h"

namespace eddy::gles {
namespace {

/// Crossings of the tank after which the speed of what has stopped counts half.
constexpr double kCrossings = 4.0;
/// Through a gap, times the speed of what drives the fluid; and cells a step, where that is not known.
constexpr double kThroughGaps = 3.0, kCellsThroughGaps = 5.0;
/// A change in one step, relative to the speed of what drives the fluid: a smooth inflow of 1 Hz changes by an eighth at most in
/// steps of 20 ms.
constexpr double kSudden = 0.25;

bool is_unknown(const FluidSetup& setup) {
    const bool weight = (setup.smoke && setup.smoke->weight != 0.0) ||
                        (setup.temperature && setup.temperature->expansion_1_k != 0.0);
    const bool free = std::any_of(setup.bodies.begin(), setup.bodies.end(),
                                  [](const BodySetup& body) { return body.coupled.has_value(); });
    // Where the tank is open there is nothing to hold the fluid up.
    const bool open = std::any_of(setup.walls.begin(), setup.walls.end(),
                                  [](const WallSetup& wall) { return wall.kind == WallKind::Open; });
    const bool falls = setup.gravity_m_s2 != glm::dvec3(0.0) && (weight || free || open);
    const WallSetup still;
    const bool walls = std::any_of(setup.walls.begin(), setup.walls.end(), [&](const WallSetup& wall) {
        return wall.velocity_m_s.glsl != still.velocity_m_s.glsl && !wall.velocity_at;
    });
    return falls || walls || setup.acceleration_m_s2.has_value();
}

glm::dvec3 size_m(const FluidSetup& setup) {
    return setup.cell_m * glm::dvec3(setup.cells);
}

// guard formula: where it has no value the wall rests
glm::dvec3 where_finite(const glm::dvec3& u) {
    return glm::length(u) < std::numeric_limits<double>::infinity() ? u : glm::dvec3(0.0);
}

}  // namespace

Driven::Driven(const FluidSetup& setup) : setup_(&setup), unknown_(is_unknown(setup)) {
    for (std::size_t w = 0; w < setup.walls.size(); ++w) {
        const WallSetup& wall = setup.walls[w];
        if (!wall.velocity_at || wall.kind == WallKind::Open) continue;
        const int axis = static_cast<int>(w / 2);
        const glm::ivec3 n = wall.varies_in_space ? setup.cells : glm::ivec3(1);
        const glm::dvec3 face_m = size_m(setup) / glm::dvec3(n);
        for (int j = 0; j < n[(axis + 2) % 3]; ++j)
            for (int i = 0; i < n[(axis + 1) % 3]; ++i) {
                glm::dvec3 x_m;
                x_m[axis] = w % 2 == 0 ? 0.0 : size_m(setup)[axis];
                x_m[(axis + 1) % 3] = (i + 0.5) * face_m[(axis + 1) % 3];
                x_m[(axis + 2) % 3] = (j + 0.5) * face_m[(axis + 2) % 3];
                if (!wall.varies_in_time)
                    steady_m_s_ =
                        std::max(steady_m_s_, glm::length(where_finite(wall.velocity_at(x_m, 0.0))));
                else
                    faces_.push_back({&wall, x_m});
            }
    }
}

void Driven::start(double speed_m_s) {
    known_lately_m_s_ = known_ever_m_s_ = speed_m_s;
    inflow_m_s_.clear();
}

void Driven::take_over(const Driven* from, double time_s) {
    known_lately_m_s_ = from ? from->known_lately_m_s_ : kNoLimit;
    known_ever_m_s_ = from ? from->known_ever_m_s_ : kNoLimit;
    inflow_m_s_.clear();
    look_at_inflow(time_s, time_s);
    // A jet that begins right here has not begun for what drove until now.
    if (from && from->inflow_m_s_.size() >= setup_->sources.size())
        std::copy_n(from->inflow_m_s_.begin(), setup_->sources.size(), inflow_m_s_.begin());
}

double Driven::look_at_inflow(double begins_s, double ends_s) {
    const std::size_t sources = setup_->sources.size();
    inflow_m_s_.resize(sources + faces_.size(), glm::dvec3(0.0));
    double change_m_s = 0.0;
    const auto found = [&](std::size_t i, const glm::dvec3& u) {
        change_m_s = std::max(change_m_s, glm::length(u - inflow_m_s_[i]));
        inflow_m_s_[i] = u;
    };
    for (std::size_t i = 0; i < sources; ++i) {
        const SourceSetup& source = setup_->sources[i];
        found(i,
              source.velocity_m_s && is_running(source, begins_s) ? *source.velocity_m_s : glm::dvec3(0.0));
    }
    for (std::size_t i = 0; i < faces_.size(); ++i)
        found(sources + i, where_finite(faces_[i].wall->velocity_at(faces_[i].x_m, ends_s)));
    return change_m_s;
}

void Driven::go_on(const std::vector<BodyState>& bodies, double time_s, double dt_s) {
    const glm::dvec3 size = size_m(*setup_);
    const double longest_m = std::max({size.x, size.y, size.z});
    double now_m_s = steady_m_s_;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        now_m_s = std::max(
            now_m_s, glm::length(bodies[i].velocity_m_s) +
                         glm::length(bodies[i].spin_rad_s) * bounding_radius_m(setup_->bodies[i].shape));
    const double change_m_s = look_at_inflow(time_s, time_s + dt_s);
    for (const glm::dvec3& u : inflow_m_s_) now_m_s = std::max(now_m_s, glm::length(u));
    known_lately_m_s_ =
        std::max(now_m_s, known_lately_m_s_ / (1.0 + known_lately_m_s_ * dt_s / (kCrossings * longest_m)));
    known_ever_m_s_ = std::max(now_m_s, known_ever_m_s_);
    is_sudden_ = change_m_s > kSudden * known_lately_m_s_;
}

double Driven::lately_m_s() const {
    return unknown_ ? kNoLimit : known_lately_m_s_;
}

double Driven::through_gaps_m_s(double dt_s) const {
    if (setup_->acceleration_m_s2) return kNoLimit;
    const double driven = kThroughGaps * known_ever_m_s_ + dt_s * glm::length(setup_->gravity_m_s2);
    return std::min(kNoLimit,
                    unknown_ ? std::max(driven, kCellsThroughGaps * setup_->cell_m / dt_s) : driven);
}

}  // namespace eddy::gles
