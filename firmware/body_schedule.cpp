#include "firmware/body_schedule.h"

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

double swing(const Scene::Body& body, double t) {
    return std::sin(2.0 * std::numbers::pi * body.oscillation->frequency_hz * t +
                    body.oscillation->phase_rad);
}

}  // namespace

BodySchedule::BodySchedule(const Scene& scene) : bodies_(scene.bodies) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Scene::Body& body = bodies_[i];
        if (body.motion == BodyMotion::Held) held_ = i;
        paths_.push_back(body.path_csv.empty() ? nullptr : read_path(body.path_csv));
    }
}

glm::dvec3 BodySchedule::position_m(std::size_t i, double time_s) const {
    const Scene::Body& body = bodies_[i];
    if (body.motion != BodyMotion::Prescribed) return body.centre_m;
    const double t = std::max(0.0, time_s - body.start_s);
    glm::dvec3 x = body.centre_m + body.velocity_m_s * t + 0.5 * t * t * body.acceleration_m_s2;
    if (body.oscillation) x += body.oscillation->amplitude_m * swing(body, t);
    if (paths_[i]) x += paths_[i]->position_m(Seconds(t));
    return x;
}

glm::dquat BodySchedule::orientation(std::size_t i, double time_s) const {
    const Scene::Body& body = bodies_[i];
    const double t = std::max(0.0, time_s - body.start_s), spin = glm::length(body.spin_rad_s);
    glm::dquat turn(1.0, 0.0, 0.0, 0.0);
    if (body.motion == BodyMotion::Prescribed && spin > 0.0)
        turn = glm::angleAxis(spin * t, body.spin_rad_s / spin);
    else if (body.motion == BodyMotion::Prescribed && body.oscillation)
        turn = glm::angleAxis(glm::radians(body.oscillation->angle_deg) * swing(body, t),
                              glm::normalize(body.oscillation->axis));
    return turn * body.orientation();
}

std::vector<gles::BodyState> BodySchedule::at(double time_s, double dt_s) const {
    std::vector<gles::BodyState> states(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        states[i].centre_m = position_m(i, time_s);
        states[i].velocity_m_s = (states[i].centre_m - position_m(i, time_s - dt_s)) / dt_s;
        states[i].orientation = orientation(i, time_s);
        const glm::dquat turned = states[i].orientation * glm::conjugate(orientation(i, time_s - dt_s));
        // Of the two rotations that lead there, the one by less than half a turn.
        const glm::dquat shorter = turned.w < 0.0 ? -turned : turned;
        if (const double sine = glm::length(glm::dvec3(shorter.x, shorter.y, shorter.z)); sine > 0.0)
            states[i].spin_rad_s =
                2.0 * std::atan2(sine, shorter.w) / dt_s * glm::dvec3(shorter.x, shorter.y, shorter.z) / sine;
    }
    return states;
}

}  // namespace eddy
