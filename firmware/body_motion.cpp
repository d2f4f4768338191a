#include "firmware/body_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/input_error.h"
#include "firmware/text_file.h"

namespace eddy {
namespace {

std::unique_ptr<emulated::RecordedMotion> read_path(const std::filesystem::path& csv) {
    try {
        return std::make_unique<emulated::RecordedMotion>(read_text_file(csv), csv.string(),
                                                          emulated::AxisMap("x,y,z"), emulated::AtEnd::Hold);
    } catch (const std::runtime_error& e) {
        throw InputError(e.what());
    }
}

}  // namespace

BodyMotions::BodyMotions(const Scene& scene) : bodies_(scene.bodies) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Scene::Body& body = bodies_[i];
        if (body.motion == BodyMotion::Held) held_ = i;
        paths_.push_back(body.path_csv.empty() ? nullptr : read_path(body.path_csv));
    }
}

glm::dvec3 BodyMotions::position_m(std::size_t i, double time_s) const {
    const Scene::Body& body = bodies_[i];
    if (body.motion != BodyMotion::Prescribed) return body.centre_m;
    const double t = std::max(0.0, time_s - body.start_s);
    glm::dvec3 x = body.centre_m + body.velocity_m_s * t + 0.5 * t * t * body.acceleration_m_s2;
    if (body.oscillation) {
        const double phase =
            2.0 * std::numbers::pi * body.oscillation->frequency_hz * t + body.oscillation->phase_rad;
        x += body.oscillation->amplitude_m * std::sin(phase);
    }
    if (paths_[i]) x += paths_[i]->position_m(Seconds(t));
    return x;
}

std::vector<gles::BodyState> BodyMotions::at(double time_s, double dt_s) const {
    std::vector<gles::BodyState> states(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        states[i].centre_m = position_m(i, time_s);
        states[i].velocity_m_s = (states[i].centre_m - position_m(i, time_s - dt_s)) / dt_s;
        if (bodies_[i].motion != BodyMotion::Prescribed || time_s <= bodies_[i].start_s) continue;
        states[i].spin_rad_s = bodies_[i].spin_rad_s;
        const double angle = glm::length(bodies_[i].spin_rad_s) * (time_s - bodies_[i].start_s);
        if (angle != 0.0)
            states[i].orientation = glm::angleAxis(angle, glm::normalize(bodies_[i].spin_rad_s));
    }
    return states;
}

}  // namespace eddy
